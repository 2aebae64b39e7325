//! Which frames of an animation are drawn, and what each is called and shows.

use std::path::{Path, PathBuf};

use tyndall_scene::{DesertKind, Scene};

use crate::Failure;

/// Most frames of one command.
const MOST_FRAMES: u32 = 1_000_000;

/// Stands for a digit of the frame's number in a file's name.
const DIGIT: char = '#';

/// Frames from the first to the last, or every n-th of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRange {
    /// First frame.
    pub first: u32,
    /// No frame is beyond it.
    pub last: u32,
    /// From a frame to the next.
    pub step: u32,
}

impl FrameRange {
    /// The frames in order.
    pub fn frames(self) -> impl ExactSizeIterator<Item = u32> {
        // `step_by` of an inclusive range has no exact length.
        let count = (self.last - self.first) / self.step + 1;
        (0..count).map(move |index| self.first + index * self.step)
    }
}

/// Frames from a text like `1-48`, `7` or `0-240x10`.
///
/// # Errors
/// A sentence for the user.
pub fn parse_frames(text: &str) -> Result<FrameRange, String> {
    let wrong = || "frames are one number or two, such as 7, 1-48, or 0-240x10 for every tenth".to_owned();
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_no_number| wrong());
    let (range, step) = text.split_once(['x', 'X']).map_or((text, Ok(1)), |(range, step)| (range, number(step)));
    let (first, last) = range.split_once('-').unwrap_or((range, range));
    let range = FrameRange { first: number(first)?, last: number(last)?, step: step? };
    if range.first > range.last || range.step == 0 {
        return Err(format!("the range is empty; {}", wrong()));
    }
    if range.last - range.first >= MOST_FRAMES {
        return Err(format!("these are more than {MOST_FRAMES} frames"));
    }
    Ok(range)
}

/// Frames in a second, or seconds of the scene in one of the animation.
///
/// # Errors
/// A sentence for the user.
pub fn parse_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().ok().filter(|rate| (1e-3..=1e5).contains(rate));
    rate.ok_or_else(|| "a number from 0.001 to 100000".to_owned())
}

/// Steps of the wind in a second of the animation; 0 holds the sand still.
///
/// # Errors
/// A sentence for the user.
pub fn parse_sand_speed(text: &str) -> Result<f64, String> {
    let speed = text.parse::<f64>().ok().filter(|speed| (0.0..=1e5).contains(speed));
    speed.ok_or_else(|| "a number of steps from 0 to 100000".to_owned())
}

/// The file of a frame: the number takes the place of the `#` in its name, with zeros in front.
///
/// # Errors
/// When the name has no such place, or more than one.
pub fn frame_path(pattern: &Path, frame: u32) -> Result<PathBuf, Failure> {
    let name = pattern.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let refusal = |what: &str| {
        let example = "frame-####.png";
        Failure::Usage(format!("{}: {what} for the number of the frame, such as {example}", pattern.display()))
    };
    let start = name.find(DIGIT).ok_or_else(|| refusal("--frames needs a place in the file's name"))?;
    let digits = name[start..].chars().take_while(|found| *found == DIGIT).count();
    let (before, after) = (&name[..start], &name[start + digits..]);
    if after.contains(DIGIT) {
        return Err(refusal("the file's name must have one place"));
    }
    Ok(pattern.with_file_name(format!("{before}{frame:0digits$}{after}")))
}

/// How fast an animation is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Frames in a second of the animation.
    pub fps: f64,
    /// Seconds that pass for clouds in a second of the animation.
    pub speed: f64,
    /// Steps that the wind makes on sand in a second of the animation.
    pub sand_speed: f64,
}

/// The scene as a frame shows it: `frame` / `fps` seconds of the animation later, as far as clouds and sand get until then.
/// Frame 0 is the scene itself; no frame depends on another.
///
/// # Errors
/// When time or step are beyond what the scene's parameters allow.
pub fn scene_of_frame(scene: &Scene, frame: u32, pace: Pace) -> Result<Scene, Failure> {
    let mut scene = scene.clone();
    let later = |speed: f64| f64::from(frame) * speed / pace.fps;
    scene.set("clouds.time_s", scene.clouds.time_s + later(pace.speed))?;
    if scene.desert.kind == DesertKind::Dunes {
        // Thirds and the like must not lose a step to rounding.
        let steps = (later(pace.sand_speed) + 1e-6).floor();
        scene.set("desert.steps", f64::from(scene.desert.steps) + steps)?;
        scene.set("sand.wind_time_s", scene.sand.wind_time_s + later(1.0))?;
    }
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Exit;

    #[test]
    fn ranges_are_numbers_with_a_dash_and_perhaps_a_step() {
        let frames = |text: &str| parse_frames(text).unwrap().frames().collect::<Vec<_>>();
        assert_eq!(frames("7"), [7], "one frame");
        assert_eq!(frames("1-4"), [1, 2, 3, 4], "both ends");
        assert_eq!(frames("0-25x10"), [0, 10, 20], "every tenth");
        assert_eq!(parse_frames("3 - 5").unwrap().frames().len(), 3, "spaces");
        for text in ["", "-", "5-", "-5", "1-2-3", "4-1", "1-5x0", "1.5", "0-1000000", "1-5x"] {
            assert!(parse_frames(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn the_number_takes_the_place_of_the_hashes_in_the_name() {
        let path = |pattern: &str, frame| frame_path(Path::new(pattern), frame);
        assert_eq!(path("a#b/frame-####.png", 7).unwrap(), Path::new("a#b/frame-0007.png"), "folders keep theirs");
        assert_eq!(path("f#.exr", 123).unwrap(), Path::new("f123.exr"), "longer numbers are not cut");
        for pattern in ["frame.png", "f##-#.png", "a#/"] {
            let failure = path(pattern, 1);
            let accepted = pattern == "a#/" && failure.is_ok();
            assert!(accepted || failure.as_ref().is_err_and(|f| f.exit() == Exit::Usage), "{pattern}: {failure:?}");
        }
    }

    #[test]
    fn frames_are_moments_of_the_scene_and_depend_on_nothing_else() {
        let mut scene = Scene::default();
        scene.clouds.time_s = 30.0;
        let pace = Pace { fps: 24.0, speed: 60.0, sand_speed: 30.0 };
        assert_eq!(scene_of_frame(&scene, 0, pace).unwrap(), scene, "frame 0 is the scene");
        let later = scene_of_frame(&scene, 36, pace).unwrap();
        assert!((later.clouds.time_s - 120.0).abs() < 1e-9, "{}", later.clouds.time_s);
        assert_eq!(later.desert, scene.desert, "no sand, no steps");
        scene.desert.kind = DesertKind::Dunes;
        scene.desert.steps = 7;
        let steps = [1, 2, 3, 36].map(|frame| scene_of_frame(&scene, frame, pace).unwrap().desert.steps);
        assert_eq!(steps, [8, 9, 10, 52], "30 steps in 24 frames, whole ones");
        let blown_s = scene_of_frame(&scene, 36, pace).unwrap().sand.wind_time_s;
        assert!((blown_s - 1.5).abs() < 1e-9, "streaks of blowing sand keep real time: {blown_s} s");
        let failure = scene_of_frame(&scene, 999_999, Pace { fps: 1.0, ..pace }).expect_err("beyond the range");
        assert!(failure.to_string().contains("`clouds.time_s` = 59999970 s is outside 0 to 100000 s"), "{failure}");
    }
}
