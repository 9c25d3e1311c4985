//! The parameters of `head view`.

use ptlib_plugin::prelude::*;

use super::parallax::Search;

choice! {
    /// How far a slanted look moves wrinkles.
    Parallax {
        /// At most by their depth, so that nothing tears at the rim of the head.
        Limited = "limited",
        /// As far as geometry says, up to ten times the depth.
        True = "true",
    }
}

choice! {
    /// Where the green part of normals points to.
    YAxis {
        /// Up in the picture, as the second texture coordinate.
        Up = "up",
        /// Down in the picture.
        Down = "down",
    }
}

choice! {
    /// How the blue part of normals is packed.
    ZRange {
        /// As it is, 0 to 1.
        Positive = "positive",
        /// Halved and moved by a half, as red and green are.
        Signed = "signed",
    }
}

params! {
    /// Parameters of `head view`.
    Params {
        /// How far the camera is turned around the head, in degrees: 0 sees the front, which looks
        /// along z, 90 what is on the side of x.
        yaw: float [hard -360.0..=360.0 soft -180.0..=180.0 unit "°"] = 0.0;
        /// How far the camera is lifted, in degrees: at 89 it looks down, at -89 up.
        pitch: float [hard -89.0..=89.0 soft -89.0..=89.0 unit "°"] = 0.0;
        /// The vertical angle that is seen, in degrees: small angles are those of long lenses.
        field_of_view "field of view":
            float [hard 5.0..=120.0 soft 20.0..=60.0 unit "°"] = 35.0;
        /// How far away the camera is, in radii of the head: half the diagonal of its bounds.
        distance: float [hard 1.0..=100.0 soft 1.5..=10.0] = 3.0;
        /// How far the light is turned around the head, in degrees, as "yaw" is. It is at the same
        /// place of the head whatever the camera does.
        light_yaw "light yaw": float [hard -360.0..=360.0 soft -180.0..=180.0 unit "°"] = 30.0;
        /// How far the light is lifted, in degrees: 89 is from above, -89 from below.
        light_pitch "light pitch": float [hard -89.0..=89.0 soft -89.0..=89.0 unit "°"] = 30.0;
        /// The part of light that reaches every place of the skin: 0 leaves shadows black, 1 shows
        /// nothing but the colour.
        ambient: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.2;
        /// How bright highlights of the skin are; 0 is none.
        specular: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.2;
        /// How small highlights of the skin are: 1 is dull, 1000 like glass.
        shine: float [hard 1.0..=1000.0 soft 1.0..=100.0] = 20.0;
        /// How the place that a slanted look meets in the wrinkles is searched for. It needs
        /// normals with heights.
        search: choice [Search] = Search::Combined;
        /// The equal steps of the search. At least 8 for each wrinkle that a ray passes: with fewer
        /// a look may go through a wrinkle.
        linear_steps "linear steps": int [hard 1..=256 soft 4..=32] = 8;
        /// The halved steps of the search, each of which doubles its accuracy. Fewer than equal
        /// steps are best.
        binary_steps "binary steps": int [hard 0..=32 soft 0..=12] = 4;
        /// How deep wrinkles are, in widths of the texture: what lies between heights 0 and 1. 0
        /// turns the search off.
        depth: float [hard 0.0..=0.1 soft 0.0..=0.01] = 0.005;
        /// The height that stays on the mesh: at 0 wrinkles rise above it, at 1 they sink below.
        level: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.0;
        /// How far a slanted look moves wrinkles.
        parallax: choice [Parallax] = Parallax::Limited;
        /// What the depth is multiplied by: 0 shows the wrinkles by their normals alone, 1 in full
        /// depth.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
        /// Where the green part of normals points to.
        y_axis "y axis": choice [YAxis] = YAxis::Up;
        /// How the blue part of normals is packed.
        z_range "z range": choice [ZRange] = ZRange::Positive;
        /// How much light hair scatters all around; 0 is none.
        k_diffuse "k diffuse": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.7;
        /// How bright the highlights of hair are, in the colour of the hair; 0 is none.
        k_specular "k specular": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.3;
        /// Red that every hair has besides, whatever its colour.
        k_ambient_red "k ambient red": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.05;
        /// Green that every hair has besides.
        k_ambient_green "k ambient green": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.05;
        /// Blue that every hair has besides.
        k_ambient_blue "k ambient blue": float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.05;
        /// How narrow the highlights of hair are: 1 is dull, 1000 a thin line.
        hair_shine "hair shine": float [hard 1.0..=1000.0 soft 1.0..=100.0] = 20.0;
        /// How wide a hair is, in heights of the image. Hair thinner than a pixel fades; 0 hides
        /// it.
        hair_width "hair width": float [hard 0.0..=0.1 soft 0.0..=0.005] = 0.001;
    }
}
