//! Tables that are made beside the frames end up as those that frames wait for.

use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use tyndall_render::FrameTarget;
use tyndall_render::sky::{OrdersRequest, OrdersTable, TableBuilding, Wake};
use tyndall_scene::Scene;

use crate::gpu_orders::small;
use crate::render::{Studio, config, scene};

const SIZE: [u32; 2] = [48, 32];

/// Longest time that a table may take on a busy computer.
const PATIENCE: Duration = Duration::from_mins(2);

/// A renderer that does not wait, and what it calls when a table is there.
fn impatient() -> (Studio, Receiver<()>) {
    let mut studio = Studio::new();
    let (sender, woken) = channel();
    let wake = Wake::new(move || sender.send(()).unwrap_or_default());
    studio.renderer.set_table_building(TableBuilding::Background(wake));
    (studio, woken)
}

fn picture(studio: &mut Studio, scene: &Scene) -> Vec<[u8; 4]> {
    studio.shoot(scene, SIZE).read_picture8(studio.gpu).unwrap_or_else(|error| panic!("{error}"))
}

/// Draws until the table is that of the scene, as the app does.
fn settled(studio: &mut Studio, woken: &Receiver<()>, scene: &Scene) -> Vec<[u8; 4]> {
    loop {
        let shown = picture(studio, scene);
        let progress = studio.renderer.table_progress();
        if !progress.building {
            return shown;
        }
        if !progress.needs_frame {
            woken.recv_timeout(PATIENCE).expect("a table in time");
        }
    }
}

fn coarse(aerosol: &str) -> Scene {
    scene("low-sun", &[("sky.orders_detail", "preview"), ("atmosphere.aerosol_optical_depth", aerosol)])
}

#[test]
fn a_table_made_beside_the_frames_gives_the_bytes_of_one_that_was_waited_for() {
    let (mut studio, woken) = impatient();
    let (clear, hazy) = (coarse("0.05"), coarse("0.6"));
    let first = picture(&mut studio, &clear);
    assert!(!studio.renderer.table_progress().building, "the first table is waited for");
    assert!(first == picture(&mut Studio::new(), &clear), "the first picture");

    let meanwhile = picture(&mut studio, &hazy);
    assert!(studio.renderer.table_progress().building, "the frame has not waited");
    let last = settled(&mut studio, &woken, &hazy);
    assert!(last == picture(&mut Studio::new(), &hazy), "the picture at rest");
    assert!(meanwhile != first, "the frame between shows the new air already");
    assert!(studio.renderer.table_progress().last_ms.is_some_and(|ms| ms > 0.0), "the time is told");
}

#[test]
fn the_last_of_many_changes_is_the_one_that_stays() {
    let (mut studio, woken) = impatient();
    for aerosol in ["0.05", "0.1", "0.2", "0.3"] {
        picture(&mut studio, &coarse(aerosol));
    }
    let last = coarse("0.4");
    let shown = settled(&mut studio, &woken, &last);
    assert!(shown == picture(&mut Studio::new(), &last), "the picture at rest is that of the last change");
}

#[test]
fn a_change_of_mind_back_to_single_scattering_leaves_nothing_to_wait_for() {
    let (mut studio, _woken) = impatient();
    picture(&mut studio, &coarse("0.05"));
    picture(&mut studio, &coarse("0.5"));
    let mut single = coarse("0.5");
    single.set_text("sky.orders", "single").expect("a valid choice");
    let shown = picture(&mut studio, &single);
    assert!(!studio.renderer.table_progress().building, "no table is needed");
    assert!(shown == picture(&mut Studio::new(), &single), "light that was scattered once");
}

fn bytes(studio: &Studio, orders: &OrdersTable) -> Vec<u8> {
    studio.gpu.read_buffer(orders.table()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_table_that_the_shaders_spread_over_frames_is_the_one_made_at_once() {
    let mut studio = Studio::new();
    let (clear, hazy) = (coarse("0.05"), coarse("0.6"));
    let models = [clear.model(), hazy.model()];
    let mut orders = OrdersTable::new(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
    orders.use_shaders();
    orders.set_building(TableBuilding::Background(Wake::new(|| {})));
    let mut shares = Vec::new();
    // The first table is waited for; then frames show other air while the second one is under way.
    for (frame, (shown, wanted)) in [(&clear, 0), (&hazy, 1), (&clear, 1)].into_iter().cycle().take(30).enumerate() {
        let wanted = if frame > 0 { 1 } else { wanted };
        studio.shoot(shown, [8, 8]);
        let request = OrdersRequest { model: &models[wanted], quality: Some(small()), brightness: 1.0 };
        orders
            .update(studio.gpu, studio.renderer.tables().columns(), &request)
            .unwrap_or_else(|error| panic!("{error}"));
        let progress = orders.progress();
        assert_eq!(progress.building, progress.needs_frame, "frames bring the table forward");
        shares.extend(progress.done);
        if frame > 0 && !progress.building {
            break;
        }
    }
    assert!(!shares.is_empty() && shares.is_sorted(), "it took some frames: {shares:?}");
    let spread = bytes(&studio, &orders);

    studio.shoot(&hazy, [8, 8]);
    let mut at_once = OrdersTable::new(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
    let columns = studio.renderer.tables().columns();
    at_once.fill_on_gpu(studio.gpu, columns, &models[1], &small()).unwrap_or_else(|error| panic!("{error}"));
    assert!(spread == bytes(&studio, &at_once), "same bytes, though the columns changed meanwhile");
}

/// Draws until the clouds are those of the scene, as the app does.
fn settled_clouds(studio: &mut Studio, woken: &Receiver<()>, scene: &Scene) -> Vec<[u8; 4]> {
    loop {
        let shown = picture(studio, scene);
        if !studio.renderer.cloud_progress().building {
            return shown;
        }
        woken.recv_timeout(PATIENCE).expect("clouds in time");
    }
}

fn cloudy(changes: &[(&str, &str)]) -> Scene {
    let small = [
        ("sky.orders", "single"),
        ("camera.pitch_deg", "50"),
        ("cloud_grid.cells_east", "32"),
        ("cloud_grid.cells_north", "32"),
        ("cloud_grid.cells_up", "16"),
        ("cloud_grid.warm_up_steps", "20"),
    ];
    scene("cumulus", &[&small, changes].concat())
}

#[test]
fn clouds_made_beside_the_frames_give_the_bytes_of_those_that_were_waited_for() {
    let (mut studio, woken) = impatient();
    let bare = picture(&mut Studio::new(), &cloudy(&[("clouds.kind", "none")]));
    let early = cloudy(&[]);
    assert!(picture(&mut studio, &early) == bare, "the first frame does not wait either");
    assert!(studio.renderer.cloud_progress().report.is_none(), "there are no clouds yet");
    let first = settled_clouds(&mut studio, &woken, &early);
    assert!(first == picture(&mut Studio::new(), &early), "the first picture at rest");

    let later = cloudy(&[("clouds.time_s", "130")]);
    assert!(picture(&mut studio, &later) == first, "the clouds before are shown meanwhile");
    let last = settled_clouds(&mut studio, &woken, &later);
    assert!(last == picture(&mut Studio::new(), &later) && last != first, "a later moment");
    let report = studio.renderer.cloud_progress().report.clone().expect("figures");
    // 130 s are six steps of 20 s and a half: shown within the seventh.
    assert_eq!((report.steps, report.cells), (27, 32 * 32 * 16), "{report:?}");
    assert!(report.statistics.cover > 0.0 && report.balls > 0, "{report:?}");
}

#[test]
fn clouds_of_another_grid_are_shown_whole_until_the_new_ones_are_there() {
    let (mut studio, woken) = impatient();
    let first = settled_clouds(&mut studio, &woken, &cloudy(&[]));
    let larger = cloudy(&[("cloud_grid.cells_east", "48"), ("cloud_grid.cell_m", "90")]);
    assert!(picture(&mut studio, &larger) == first, "the old grid's clouds in the old grid's place");
    let last = settled_clouds(&mut studio, &woken, &larger);
    assert!(last == picture(&mut Studio::new(), &larger), "the new grid");
}

#[test]
fn a_long_simulation_is_given_up_for_a_newer_one() {
    let (mut studio, woken) = impatient();
    // Minutes of steps, which nobody waits for in the end.
    let endless = cloudy(&[
        ("cloud_grid.warm_up_steps", "10000"),
        ("cloud_grid.cells_north", "1024"),
        ("cloud_grid.cells_east", "1024"),
    ]);
    picture(&mut studio, &endless);
    let started = std::time::Instant::now();
    let short = cloudy(&[]);
    settled_clouds(&mut studio, &woken, &short);
    assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
    let refused =
        cloudy(&[("cloud_wind.ceiling_speed_m_s", "100"), ("cloud_grid.cell_m", "1"), ("cloud_grid.step_s", "600")]);
    let mut target = FrameTarget::new(studio.gpu, SIZE, config()).unwrap_or_else(|error| panic!("{error}"));
    let error = loop {
        match studio.renderer.render(studio.gpu, &refused, &mut target) {
            Ok(_) => woken.recv_timeout(PATIENCE).expect("an answer in time"),
            Err(error) => break error.to_string(),
        }
    };
    assert!(error.contains("cells per step"), "{error}");
}
