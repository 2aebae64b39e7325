use super::*;

const SIZE: [usize; 2] = [128, 64];

/// A dune whose crest, 8 cells high, stands at x = 60: 13 degrees to windward, 33 to lee; it is lower towards large y.
fn dune() -> HeightGrid {
    let height = |index: usize| {
        let [x, y] = [index % SIZE[0], index / SIZE[0]].map(|at| at as f64);
        let crest = 8.0 - 0.05 * y;
        let off = x - 60.0;
        (crest + if off < 0.0 { 0.23 * off } else { -0.65 * off }).max(0.0) as f32
    };
    HeightGrid::new(SIZE, (0..SIZE[0] * SIZE[1]).map(height).collect()).expect("as many heights as cells")
}

/// Sand everywhere.
fn sand() -> Vec<f32> {
    vec![1.0; SIZE[0] * SIZE[1]]
}

fn mirrored(bed: &HeightGrid) -> HeightGrid {
    let [nx, ny] = SIZE;
    let heights = (0..nx * ny).map(|index| bed.heights()[(ny - 1 - index / nx) * nx + index % nx]).collect();
    HeightGrid::new(SIZE, heights).expect("as many heights as before")
}

fn columns(bed: &HeightGrid, toward_deg: f64, speed_m_per_s: f64) -> Vec<BlownColumn> {
    let wind = SandWind { toward_deg, speed_m_per_s };
    blown_columns((bed, &sand()), 1.5, Edges::Periodic, wind).unwrap().expect("the wind is strong enough")
}

#[test]
fn no_sand_flies_in_still_air_or_below_the_threshold_even_over_crests() {
    for speed_m_per_s in [0.0, 1.0, 2.8] {
        let wind = SandWind { toward_deg: 10.0, speed_m_per_s };
        let found = blown_columns((&dune(), &sand()), 1.0, Edges::Periodic, wind).unwrap();
        assert!(found.is_none(), "{speed_m_per_s} m/s");
    }
    // Over crests alone.
    let some = columns(&dune(), 0.0, 4.5);
    let row = |x: usize| some[32 * SIZE[0] + x].depth;
    assert!(row(59) > 0.0 && row(10).abs() < 1e-12, "crest {}, before the dune {}", row(59), row(10));
}

#[test]
fn the_depth_of_air_is_linear_in_the_flux() {
    let [one, three] = [1.0, 3.0].map(|flux| {
        let cell = Cell { bed_m: 4.0, flux };
        cell.hopping(10.0).plus(cell.fine(10.0).carried(7.0, 10.0)).column(4.0)
    });
    assert!((three.depth / one.depth - 3.0).abs() < 1e-6, "{one:?}, {three:?}");
    assert!((three.height_m - one.height_m).abs() < 1e-6, "as high as before: {one:?}, {three:?}");
}

#[test]
fn plumes_leave_the_brink_sink_spread_and_thin_out_exponentially() {
    let wind_m_per_s = 12.0;
    let columns = columns(&dune(), 0.0, wind_m_per_s);
    let at = |x: usize| columns[32 * SIZE[0] + x];
    let brink = (60..70).find(|&x| at(x).depth < 0.5 * at(x - 1).depth).expect("hopping grains stay behind");
    let (near, far) = (at(brink + 2), at(brink + 12));
    let way_m = 15.0;
    let length_m = FINE_HEIGHT_M * wind_m_per_s / FALL_M_PER_S;
    let kept = f64::from(far.depth / near.depth);
    assert!((kept / (-way_m / length_m).exp() - 1.0).abs() < 0.01, "{near:?}, {far:?}: {kept} are left");
    let sunk_m = f64::from(near.height_m - far.height_m);
    assert!((sunk_m - way_m * FALL_M_PER_S / wind_m_per_s).abs() < 0.02, "{near:?}, {far:?}");
    let wider_m2 = f64::from(far.variance_m2 - near.variance_m2);
    assert!((wider_m2 - SPREADING_M * way_m).abs() < 0.03, "{near:?}, {far:?}");
    let over_m = f64::from(near.height_m) - 1.5 * f64::from(dune().heights()[32 * SIZE[0] + brink + 2]);
    assert!(over_m > 1.0, "the plume flies {over_m} m over the lee");
}

#[test]
fn a_mirrored_bed_has_mirrored_plumes() {
    let (bed, [nx, ny]) = (dune(), SIZE);
    for toward_deg in [0.0, 37.0] {
        let there = columns(&bed, toward_deg, 14.0);
        let back = columns(&mirrored(&bed), -toward_deg, 14.0);
        let deepest = there.iter().fold(0.0_f32, |most, column| most.max(column.depth));
        for (index, there) in there.iter().enumerate() {
            let back = back[(ny - 1 - index / nx) * nx + index % nx];
            let off = (there.depth - back.depth).abs() / deepest;
            assert!(off < 1e-4, "cell {index} at {toward_deg} degrees: {there:?} and {back:?}");
        }
    }
}

#[test]
fn stronger_winds_hold_more_sand_and_carry_it_further() {
    let [fresh, strong] = [10.0, 18.0].map(|speed| columns(&dune(), 0.0, speed));
    let [fresh, strong] = [fresh, strong].map(|columns| {
        let at = |x: usize| columns[32 * SIZE[0] + x].depth;
        [at(58), at(75) / at(65)]
    });
    assert!(strong[0] > 2.0 * fresh[0], "over the crest {} and {}", fresh[0], strong[0]);
    assert!(strong[1] > fresh[1], "left after 15 m {} and {}", fresh[1], strong[1]);
}

#[test]
fn no_sand_flies_over_bare_ground_and_a_cover_of_another_size_is_refused() {
    let wind = SandWind { toward_deg: 0.0, speed_m_per_s: 20.0 };
    let bare: Vec<f32> = dune().heights().iter().map(|height| if *height > 0.5 { 1.0 } else { 0.0 }).collect();
    let columns = blown_columns((&dune(), &bare), 1.0, Edges::Periodic, wind).unwrap().expect("a storm");
    let at = |x: usize| columns[32 * SIZE[0] + x].depth;
    assert!(at(10).abs() < 1e-12 && at(58) > 0.01, "before the dune {}, on its crest {}", at(10), at(58));
    let refused = blown_columns((&dune(), &bare[1..]), 1.0, Edges::Periodic, wind).unwrap_err().to_string();
    assert!(refused.starts_with("the cover of sand has 8191 cells"), "{refused}");
}

#[test]
fn light_reaches_over_a_crest_by_its_rise() {
    let bed = dune();
    // From the west, over the crest at x = 60, 6.4 cells high in row 32.
    let heights = light_heights_cells(&bed, Edges::Periodic, 180.0, 0.1).unwrap();
    let found = heights[32 * SIZE[0] + 80];
    assert!((found - (6.4 - 0.1 * 20.0)).abs() < 0.01, "{found} cells");
    assert!(light_heights_cells(&bed, Edges::Periodic, 0.0, f64::NAN).is_err(), "no number");
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let wind = SandWind { toward_deg: 0.0, speed_m_per_s: -3.0 };
    let message = blown_columns((&dune(), &sand()), 1.0, Edges::Open, wind).unwrap_err().to_string();
    assert!(message.starts_with("speed of the wind = -3 m/s is outside 0 to 100 m/s"), "{message}");
}
