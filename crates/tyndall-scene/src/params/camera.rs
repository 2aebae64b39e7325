//! Where the camera stands and looks.

use tyndall_core::{choices, params};

choices! {
    /// How the camera makes a picture of the world.
    pub enum CameraProjection {
        /// Through a pinhole: what is far is small.
        Perspective = "perspective",
        /// Along parallel lines of sight, from infinitely far away: what is far is as large as what is near.
        Orthographic = "orthographic",
    }
}

params! {
    /// A camera near the ground. [`crate::camera`] has its axes and matrices.
    pub struct CameraParams {
        /// Position towards the east.
        x_m: f64 = 0.0, ["m", -1000000.0..=1000000.0, Linear], "east of the scene's origin";
        /// Position towards the north.
        y_m: f64 = 0.0, ["m", -1000000.0..=1000000.0, Linear], "north of the scene's origin";
        /// Height above the ground; 2 is a person's eye, 10000 an airliner, 400000 a space station.
        altitude_m: f64 = 2.0, ["m", 0.1..=100000000.0, Log], "above sea level";
        /// Direction of view: 0 is north, 90 east.
        heading_deg: f64 = 0.0, ["deg", -360.0..=360.0, Linear], "clockwise from north";
        /// Angle of view above the horizon; 90 looks straight up.
        pitch_deg: f64 = 10.0, ["deg", -90.0..=90.0, Linear], "upwards from the horizon";
        /// Turn about the direction of view; a positive angle lowers the camera's right side.
        roll_deg: f64 = 0.0, ["deg", -180.0..=180.0, Linear], "clockwise seen from behind the camera";
        /// Angle between the lower and the upper edge of the picture. Used by the perspective projection.
        field_of_view_deg: f64 = 60.0, ["deg", 1.0..=170.0, Linear], "pinhole camera, vertical";
        /// How the world becomes a picture. An orthographic picture has one direction of view: the sky in it has one colour, and
        /// neither discs nor stars; it shows clouds and level ground, and no landscape.
        projection: CameraProjection = CameraProjection::Perspective, "scene convention";
        /// Width of what an orthographic picture shows. Used by the orthographic projection.
        width_m: f64 = 1000.0, ["m", 0.1..=1000000.0, Log], "across the direction of view";
    }
}
