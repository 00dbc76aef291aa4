//! A tile of points that keep a distance from each other, also across its sides.

use super::hash::hash;
use super::permutation::permute;

/// A point of the tile, which the key shifts. In order, the first points lie far apart for any number of
/// samples; if not `in_order`, the key permutes them, so that two dimensions are combined by chance.
pub(super) fn point(index: u32, samples: u32, key: u32, in_order: bool) -> [u16; 2] {
    // Beyond the last point, all points come again with another shift.
    let key = hash(index >> 8, key);
    let index = if in_order { index } else { permute(index & 0xFF, samples.min(256), key) };
    let [x, y] = TILE.get(index as usize & 0xFF).copied().unwrap_or_default();
    [(x, key), (y, hash(key, 1))].map(|(place, shift)| (u16::from(place) << 8).wrapping_add(shift as u16))
}

/// Points in 256ths of the tile's side. Each one is the farthest from all before it among as many candidates
/// as four times their number (Mitchell, "Spectrally Optimal Sampling for Distribution Ray Tracing", 1991).
///
/// Dart throwing with a fixed distance (Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", 2007)
/// gives points in no order, of which the first few lie in a corner. These points can be used up to any
/// number.
#[rustfmt::skip]
static TILE: [[u8; 2]; 256] = [
    [128, 128], [238, 232], [119, 6], [11, 105], [61, 198], [213, 62], [201, 157], [47, 33],
    [170, 230], [65, 128], [119, 68], [5, 167], [135, 192], [167, 79], [52, 84], [252, 29],
    [180, 30], [20, 209], [48, 243], [206, 108], [213, 201], [102, 218], [162, 160], [90, 33],
    [88, 170], [200, 255], [240, 86], [241, 134], [166, 121], [98, 107], [85, 70], [46, 159],
    [177, 190], [153, 12], [20, 62], [10, 251], [134, 224], [82, 253], [130, 36], [233, 181],
    [127, 98], [30, 131], [221, 17], [158, 50], [113, 152], [136, 167], [206, 228], [245, 204],
    [105, 191], [214, 135], [38, 187], [194, 85], [74, 224], [231, 44], [49, 219], [22, 21],
    [231, 111], [241, 4], [58, 10], [207, 38], [186, 55], [67, 50], [188, 134], [83, 147],
    [43, 108], [252, 58], [74, 94], [144, 72], [152, 209], [8, 82], [188, 212], [46, 60],
    [104, 130], [235, 156], [117, 240], [147, 142], [222, 249], [148, 244], [151, 97], [8, 133],
    [178, 255], [83, 199], [201, 184], [30, 90], [37, 6], [60, 176], [5, 228], [173, 99],
    [153, 179], [113, 48], [12, 186], [104, 86], [115, 173], [216, 87], [13, 41], [26, 152],
    [119, 206], [27, 238], [219, 167], [69, 28], [95, 236], [110, 26], [65, 69], [145, 117],
    [98, 8], [81, 117], [196, 18], [233, 65], [184, 172], [25, 172], [228, 211], [180, 152],
    [5, 13], [187, 114], [94, 53], [49, 137], [62, 152], [169, 207], [253, 118], [160, 31],
    [31, 43], [64, 110], [115, 116], [140, 54], [135, 14], [66, 240], [81, 15], [166, 141],
    [132, 248], [192, 239], [253, 149], [131, 149], [101, 68], [25, 114], [250, 244], [252, 98],
    [220, 150], [251, 180], [237, 22], [130, 81], [38, 205], [76, 182], [37, 75], [201, 125],
    [197, 69], [170, 16], [222, 226], [32, 220], [152, 227], [87, 132], [157, 194], [172, 61],
    [248, 220], [97, 153], [5, 204], [217, 120], [173, 44], [163, 253], [250, 73], [169, 176],
    [42, 123], [216, 184], [117, 225], [112, 99], [88, 86], [21, 6], [193, 100], [143, 28],
    [104, 249], [11, 153], [193, 196], [250, 43], [72, 166], [146, 157], [63, 213], [42, 173],
    [247, 164], [182, 73], [227, 96], [80, 56], [130, 113], [37, 22], [86, 215], [123, 161],
    [122, 186], [230, 196], [54, 99], [202, 53], [202, 143], [158, 66], [97, 203], [209, 10],
    [126, 52], [223, 31], [101, 176], [67, 254], [138, 209], [24, 195], [89, 185], [155, 130],
    [192, 37], [124, 22], [217, 48], [184, 227], [117, 137], [79, 42], [50, 46], [228, 139],
    [202, 210], [22, 76], [220, 74], [157, 109], [80, 239], [7, 68], [154, 82], [209, 243],
    [254, 1], [71, 141], [60, 227], [20, 226], [57, 23], [141, 130], [67, 82], [147, 42],
    [117, 82], [38, 145], [40, 232], [205, 170], [11, 28], [245, 191], [139, 91], [103, 38],
    [179, 87], [179, 242], [210, 24], [162, 240], [248, 15], [235, 248], [87, 99], [9, 54],
    [95, 120], [16, 93], [233, 124], [52, 189], [14, 121], [145, 1], [179, 124], [184, 12],
    [206, 95], [50, 0], [106, 164], [132, 66], [175, 218], [33, 59], [12, 239], [52, 71],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_keep_their_distance() {
        let across = |a: u8, b: u8| {
            let apart = a.abs_diff(b);
            f64::from(apart.min(0u8.wrapping_sub(apart))) / 256.0
        };
        for count in [2, 4, 8, 16, 32, 64, 128, 256] {
            let mut nearest = f64::INFINITY;
            for (number, a) in TILE[..count].iter().enumerate() {
                for b in &TILE[..number] {
                    nearest = nearest.min(across(a[0], b[0]).hypot(across(a[1], b[1])));
                }
            }
            // The distance in the densest packing, a hexagonal lattice.
            let most = (2.0 / (3f64.sqrt() * count as f64)).sqrt();
            assert!(nearest > 0.66 * most, "{count} points: {:.3}", nearest / most);
        }
    }
}
