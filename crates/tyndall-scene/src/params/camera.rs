//! Where the camera stands and looks.

use tyndall_core::params;

params! {
    /// A pinhole camera near the ground. [`crate::camera`] has its axes and matrices.
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
        /// Angle between the lower and the upper edge of the picture.
        field_of_view_deg: f64 = 60.0, ["deg", 1.0..=170.0, Linear], "pinhole camera, vertical";
    }
}
