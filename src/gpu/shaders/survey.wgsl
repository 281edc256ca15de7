// Numbers of some pixels, spread evenly over the picture.

@group(0) @binding(0) var radiance_mean: texture_2d<f32>;
@group(0) @binding(1) var display_mean: texture_2d<f32>;
@group(0) @binding(2) var other_radiance: texture_2d<f32>;

// As `light::luminance_of`.
const LUMINANCE = vec3f(0.21263901, 0.71516868, 0.07219232);
// Pixels of the survey, along each side.
const PLACES = vec2f(96.0, 64.0);

// Luminance and illuminance by the view's method, then by the other one; -1 where no surface is seen.
@fragment
fn survey(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let at = vec2i(place.xy / PLACES * vec2f(textureDimensions(radiance_mean)));
    let covered = textureLoad(display_mean, at, 0).w;
    if covered == 0.0 {
        return vec4f(-1.0);
    }
    let mine = textureLoad(radiance_mean, at, 0);
    let other = textureLoad(other_radiance, at, 0);
    return vec4f(dot(LUMINANCE, mine.xyz), mine.w / covered, dot(LUMINANCE, other.xyz), other.w / covered);
}
