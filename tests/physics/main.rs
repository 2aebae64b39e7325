//! Physics from end to end: the f64 reference against independent data, the GPU's tables and frames against the
//! reference, and laws that a picture obeys.

mod aerial;
mod background;
mod cloud_air;
mod cloud_files;
mod cloud_outputs;
mod cloud_pictures;
mod cloud_shadows;
mod clouds;
mod desert;
mod desert_mesh;
mod desert_playing;
mod desert_wind;
mod dome;
mod gpu_orders;
mod gpu_tables;
mod laws;
mod moonlight;
mod night;
mod panorama;
mod pictures;
mod random_walks;
mod reference_data;
mod render;
mod splat_pictures;
mod sun_disc;
mod table;
mod twins;
