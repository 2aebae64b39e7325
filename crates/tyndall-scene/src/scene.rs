//! The scene: all groups of parameters, reached by path.

use tyndall_core::units::M_PER_KM;
use tyndall_core::{ParamError, ParamInfo, ParamSet};
use tyndall_scattering::aerosol::clearest_visibility_km;
use tyndall_scattering::refraction::RefractiveAir;

use crate::files::SceneFolder;
use crate::landscape::Landscape;
use crate::{
    AbrasionParams, AerosolInput, Atmosphere, AtmosphereParams, CameraParams, CameraProjection, ClassicParams,
    CloudGridParams, CloudKind, CloudMatterParams, CloudParams, CloudVapourParams, CloudWindParams, CloudsParams,
    DesertKind, DesertParams, DesertSceneParams, DuneParams, FilmParams, GroundParams, HazeParams, ImageParams,
    LandscapeKind, LandscapeParams, MoonParams, MoonPosition, Orders, RippleParams, SandParams, SceneError, SceneHash,
    SkyKind, SkyMode, SkyParams, StarsParams, SunDirection, SunParams, VegetationParams, WindParams, astronomy,
    astronomy::MoonState, brief::brief, nearest::nearest, sun,
};

/// Most cells of the clouds of a scene: a frame needs some 60 bytes for each.
pub(crate) const MOST_CLOUD_CELLS: u64 = 1 << 26;

/// Everything that a picture depends on, and its title.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Title for people; one line.
    pub title: String,
    /// What the scene shows.
    pub description: String,
    /// Folder that relative paths in the scene start from: that of its file, or where the program runs when empty.
    pub folder: SceneFolder,
    /// Where the camera stands and looks.
    pub camera: CameraParams,
    /// Where the sun stands and what its disc looks like.
    pub sun: SunParams,
    /// Where the moon stands and how it shines.
    pub moon: MoonParams,
    /// The stars and the glow of the night.
    pub stars: StarsParams,
    /// Air, aerosol and ozone.
    pub atmosphere: AtmosphereParams,
    /// Haze or fog near the ground.
    pub haze: HazeParams,
    /// The ground.
    pub ground: GroundParams,
    /// Hills or mountains on the ground.
    pub landscape: LandscapeParams,
    /// Whether there are clouds, and how they are drawn.
    pub clouds: CloudsParams,
    /// The box that clouds live in.
    pub cloud_grid: CloudGridParams,
    /// Where vapour is supplied to clouds.
    pub cloud_vapour: CloudVapourParams,
    /// Wind among the clouds.
    pub cloud_wind: CloudWindParams,
    /// The matter of the clouds.
    pub cloud_matter: CloudMatterParams,
    /// Whether there is a desert.
    pub desert: DesertSceneParams,
    /// The sand of the desert.
    pub dunes: DuneParams,
    /// The rule of Onoue and Nishita, where the sand follows it.
    pub dune_classic: ClassicParams,
    /// The winds over the desert.
    pub dune_wind: WindParams,
    /// Plants that hold sand.
    pub dune_plants: VegetationParams,
    /// Rock that blown sand wears.
    pub dune_rock: AbrasionParams,
    /// The tile of ripples on the sand.
    pub ripples: RippleParams,
    /// What the sand looks like.
    pub sand: SandParams,
    /// How the sky is computed.
    pub sky: SkyParams,
    /// Exposure and display.
    pub film: FilmParams,
    /// Size of the picture.
    pub image: ImageParams,
}

impl Scene {
    /// The groups with their names in scene files, in the order in which they are shown.
    #[must_use]
    pub fn groups(&self) -> [(&'static str, &dyn ParamSet); 24] {
        [
            ("camera", &self.camera),
            ("sun", &self.sun),
            ("moon", &self.moon),
            ("stars", &self.stars),
            ("atmosphere", &self.atmosphere),
            ("haze", &self.haze),
            ("ground", &self.ground),
            ("landscape", &self.landscape),
            ("clouds", &self.clouds),
            ("cloud_grid", &self.cloud_grid),
            ("cloud_vapour", &self.cloud_vapour),
            ("cloud_wind", &self.cloud_wind),
            ("cloud_matter", &self.cloud_matter),
            ("desert", &self.desert),
            ("dunes", &self.dunes),
            ("dune_classic", &self.dune_classic),
            ("dune_wind", &self.dune_wind),
            ("dune_plants", &self.dune_plants),
            ("dune_rock", &self.dune_rock),
            ("ripples", &self.ripples),
            ("sand", &self.sand),
            ("sky", &self.sky),
            ("film", &self.film),
            ("image", &self.image),
        ]
    }

    /// [`Scene::groups`], to change them.
    #[must_use]
    pub fn groups_mut(&mut self) -> [(&'static str, &mut dyn ParamSet); 24] {
        [
            ("camera", &mut self.camera),
            ("sun", &mut self.sun),
            ("moon", &mut self.moon),
            ("stars", &mut self.stars),
            ("atmosphere", &mut self.atmosphere),
            ("haze", &mut self.haze),
            ("ground", &mut self.ground),
            ("landscape", &mut self.landscape),
            ("clouds", &mut self.clouds),
            ("cloud_grid", &mut self.cloud_grid),
            ("cloud_vapour", &mut self.cloud_vapour),
            ("cloud_wind", &mut self.cloud_wind),
            ("cloud_matter", &mut self.cloud_matter),
            ("desert", &mut self.desert),
            ("dunes", &mut self.dunes),
            ("dune_classic", &mut self.dune_classic),
            ("dune_wind", &mut self.dune_wind),
            ("dune_plants", &mut self.dune_plants),
            ("dune_rock", &mut self.dune_rock),
            ("ripples", &mut self.ripples),
            ("sand", &mut self.sand),
            ("sky", &mut self.sky),
            ("film", &mut self.film),
            ("image", &mut self.image),
        ]
    }

    /// Value of the parameter at a path like `sun.elevation_deg`; choices count from 0, toggles are 0 and 1.
    ///
    /// # Errors
    /// When there is no such parameter.
    pub fn get(&self, path: &str) -> Result<f64, SceneError> {
        let (group, index) = self.find(path)?;
        Ok(self.groups()[group].1.get(index))
    }

    /// Sets the parameter at a path.
    ///
    /// # Errors
    /// When there is no such parameter or it does not take the value.
    pub fn set(&mut self, path: &str, value: f64) -> Result<(), SceneError> {
        self.set_checked(path, |info| info.check(value))
    }

    /// Sets the parameter at a path from text as users write it: a number, `true`, `false`, or a choice's name.
    ///
    /// # Errors
    /// When there is no such parameter or the text is not an allowed value.
    pub fn set_text(&mut self, path: &str, text: &str) -> Result<(), SceneError> {
        let (group, name) = path.split_once('.').unwrap_or((path, ""));
        for (group, set) in self.groups_mut().into_iter().filter(|(known, _)| *known == group) {
            if set.text_position(name).is_some() {
                return set.set_text(name, text).map_err(|source| SceneError::Value { group, source });
            }
        }
        self.set_checked(path, |info| info.parse(text))
    }

    /// Checks every value and what must hold between them: the date exists, the ozone lies inside the atmosphere.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), SceneError> {
        for (group, set) in self.groups() {
            check_group(group, set)?;
        }
        let AtmosphereParams { ozone_du, ozone_altitude_km, top_altitude_km, .. } = self.atmosphere;
        if ozone_du > 0.0 && ozone_altitude_km > top_altitude_km {
            return Err(SceneError::OzoneAboveTop { ozone_altitude_km, top_altitude_km });
        }
        let (visibility_km, clearest_km) =
            (self.atmosphere.aerosol_visibility_km, clearest_visibility_km(&self.atmosphere));
        if self.atmosphere.aerosol_input == AerosolInput::Visibility && visibility_km > clearest_km {
            return Err(SceneError::VisibilityBeyondAir { visibility_km, clearest_km });
        }
        self.check_clouds()?;
        self.check_desert()?;
        if self.camera.projection == CameraProjection::Orthographic && self.landscape.kind != LandscapeKind::None {
            return Err(SceneError::OrthographicLandscape);
        }
        self.moon().map(|_state| ())
    }

    /// That the grid of the clouds is not too large; nothing without clouds.
    fn check_clouds(&self) -> Result<(), SceneError> {
        let grid = &self.cloud_grid;
        let size = [grid.cells_east, grid.cells_north, grid.cells_up];
        let cells = size.map(u64::from).iter().product::<u64>();
        if self.clouds.kind == CloudKind::Automaton && cells > MOST_CLOUD_CELLS {
            return Err(SceneError::CloudCells { size });
        }
        Ok(())
    }

    /// That nothing else stands where the desert lies; nothing without a desert.
    fn check_desert(&self) -> Result<(), SceneError> {
        if self.desert.kind == DesertKind::None {
            return Ok(());
        }
        let DesertSceneParams { terrain_low_m: low_m, terrain_high_m: high_m, .. } = self.desert;
        if !self.desert.terrain.is_empty() && low_m > high_m {
            return Err(SceneError::TerrainRange { low_m, high_m });
        }
        if self.landscape.kind != LandscapeKind::None {
            return Err(SceneError::DesertAndLandscape { landscape: self.landscape.kind.name() });
        }
        if self.camera.projection == CameraProjection::Orthographic {
            return Err(SceneError::OrthographicDesert);
        }
        Ok(())
    }

    /// The desert's simulation, all groups together; `None` without a desert.
    #[must_use]
    pub fn dune_params(&self) -> Option<DesertParams> {
        let (dunes, classic, wind) = (self.dunes.clone(), self.dune_classic.clone(), self.dune_wind.clone());
        let (plants, rock) = (self.dune_plants.clone(), self.dune_rock.clone());
        (self.desert.kind == DesertKind::Dunes).then_some(DesertParams { dunes, classic, wind, plants, rock })
    }

    /// The clouds' simulation, all groups together; `None` without clouds and for those of a file.
    #[must_use]
    pub fn cloud_params(&self) -> Option<CloudParams> {
        let (grid, vapour) = (self.cloud_grid.clone(), self.cloud_vapour.clone());
        let (wind, matter) = (self.cloud_wind.clone(), self.cloud_matter.clone());
        (self.clouds.kind == CloudKind::Automaton).then_some(CloudParams { grid, vapour, wind, matter })
    }

    /// Planet, air and ground as the model that all light transport reads, at the eight wavelengths.
    #[must_use]
    pub fn model(&self) -> Atmosphere {
        Atmosphere::new(&self.atmosphere, &self.ground).with_haze(&self.haze)
    }

    /// Direction to the sun, from its angles or from date, time and place.
    ///
    /// # Errors
    /// When a value of the sun is not allowed or the date does not exist.
    pub fn sun_direction(&self) -> Result<SunDirection, SceneError> {
        check_group("sun", &self.sun)?;
        sun::direction(&self.sun)
    }

    /// Where the moon stands and how it is lit; `None` without a moon.
    ///
    /// # Errors
    /// When a value of the sun or the moon is not allowed or the date does not exist.
    pub fn moon(&self) -> Result<Option<MoonState>, SceneError> {
        check_group("moon", &self.moon)?;
        astronomy::moon_state(&self.moon, &self.sun, self.sun_direction()?.unit())
    }

    /// Rotation from the axes of the star catalogue (equator of J2000) to those of the scene.
    ///
    /// # Errors
    /// When a value of the sun is not allowed or the date does not exist.
    pub fn world_from_stars(&self) -> Result<glam::DMat3, SceneError> {
        check_group("sun", &self.sun)?;
        astronomy::world_from_stars(&self.stars, &self.sun)
    }

    /// The air that lifts and flattens the discs of sun and moon; `None` when refraction is off.
    #[must_use]
    pub fn refractive_air(&self) -> Option<RefractiveAir> {
        let (air, sun) = (&self.atmosphere, &self.sun);
        let (radius_m, scale_height_m) = (air.planet_radius_km * M_PER_KM, air.air_scale_height_km * M_PER_KM);
        let bent = RefractiveAir::new(radius_m, air.air_density, scale_height_m, sun.pressure_hpa, sun.temperature_c);
        sun.refraction.then_some(bent)
    }

    /// The scene with its camera's altitude above sea level: `camera.altitude_m` counts from what the landscape has under
    /// the camera. Renderers and headers start from here.
    #[must_use]
    pub fn grounded(&self) -> Self {
        let mut scene = self.clone();
        scene.camera.altitude_m += Landscape::new(&self.landscape).ground_m(self.camera.x_m, self.camera.y_m);
        if scene.sky.kind == SkyKind::Black {
            scene.take_air_away();
        }
        if scene.camera.projection == CameraProjection::Orthographic {
            // One direction of view: a disc would fill the picture.
            (scene.sun.disc, scene.moon.disc, scene.stars.visible) = (false, false, false);
            scene.sky.mode = SkyMode::PerPixel;
        }
        scene
    }

    /// Leaves the sun and what it shines on.
    fn take_air_away(&mut self) {
        let air = &mut self.atmosphere;
        (air.air_density, air.aerosol_input, air.aerosol_optical_depth) = (0.0, AerosolInput::OpticalDepth, 0.0);
        air.ozone_du = 0.0;
        self.haze.enabled = false;
        self.sky.orders = Orders::Single;
        self.sun.disc = false;
        self.moon.position = MoonPosition::None;
        (self.stars.visible, self.stars.airglow_cd_m2) = (false, 0.0);
        self.ground.material = tyndall_scattering::params::GroundMaterial::Colour;
        (self.ground.red, self.ground.green, self.ground.blue) = (0.0, 0.0, 0.0);
    }

    /// Hash of all parameters: what a picture's header stores to tell whether the picture is still that of its scene.
    #[must_use]
    pub fn hash(&self) -> SceneHash {
        SceneHash::of(self)
    }

    /// The declaration of the parameter at a path.
    pub(crate) fn info(&self, path: &str) -> Result<&'static ParamInfo, SceneError> {
        let (group, index) = self.find(path)?;
        Ok(&self.groups()[group].1.info()[index])
    }

    fn set_checked(
        &mut self,
        path: &str,
        value: impl Fn(&ParamInfo) -> Result<f64, ParamError>,
    ) -> Result<(), SceneError> {
        let (group, index) = self.find(path)?;
        let (group, set) = &mut self.groups_mut()[group];
        let value = value(&set.info()[index]).map_err(|source| SceneError::Value { group, source })?;
        set.set_unchecked(index, value);
        Ok(())
    }

    /// Position of the group in [`Scene::groups`] and of the parameter in the group.
    fn find(&self, path: &str) -> Result<(usize, usize), SceneError> {
        let groups = self.groups();
        let Some((group_name, name)) = path.split_once('.') else {
            return Err(self.unknown_group(path));
        };
        let Some(group) = groups.iter().position(|(known, _)| *known == group_name) else {
            return Err(self.unknown_group(group_name));
        };
        match groups[group].1.position(name) {
            Ok(index) => Ok((group, index)),
            Err(source @ ParamError::IsText { .. }) => Err(SceneError::Value { group: groups[group].0, source }),
            Err(_unknown) => Err(self.unknown_parameter(group_name, name)),
        }
    }

    /// The refusal of a group, with the nearest group or, for a parameter without its group, the parameter's path.
    pub(crate) fn unknown_group(&self, name: &str) -> SceneError {
        let name = &brief(name);
        let group = nearest(name, self.groups().into_iter().map(|(group, _)| group)).map(str::to_owned);
        SceneError::UnknownGroup { name: name.clone(), nearest: self.home_of(name).or(group) }
    }

    /// The refusal of a parameter, with the nearest one of the group, or its home in another group.
    pub(crate) fn unknown_parameter(&self, group: &str, name: &str) -> SceneError {
        let name = &brief(name);
        let set = self.groups().into_iter().find(|(known, _)| *known == group);
        let texts = set.iter().flat_map(|(_, set)| set.text_info()).map(|info| info.name);
        let names = set.iter().flat_map(|(_, set)| set.info()).map(|info| info.name).chain(texts);
        let near = nearest(name, names).map(|near| format!("{group}.{near}"));
        SceneError::UnknownParameter { path: format!("{group}.{name}"), nearest: self.home_of(name).or(near) }
    }

    /// Path of the parameter with exactly this name in any group.
    fn home_of(&self, name: &str) -> Option<String> {
        let home =
            self.groups().into_iter().find(|(_, set)| set.position(name).is_ok() || set.text_position(name).is_some());
        home.map(|(group, _)| format!("{group}.{name}"))
    }
}

fn check_group(group: &'static str, set: &dyn ParamSet) -> Result<(), SceneError> {
    for (index, info) in set.info().iter().enumerate() {
        info.check(set.get(index)).map_err(|source| SceneError::Value { group, source })?;
    }
    for (index, info) in set.text_info().iter().enumerate() {
        info.check(set.text(index)).map_err(|source| SceneError::Value { group, source })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
