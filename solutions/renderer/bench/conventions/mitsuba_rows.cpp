#include "known.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bench {
namespace {

/// The share of Mitsuba's Gaussian within half a pixel of its middle: deviation 1/2, radius 2, less
/// its value there, as a table of 31 steps.
double gaussian_middle() {
  double middle = 0, all = 0;
  for (int i = 0; i < 31; ++i) {
    const double x = 2.0 * i / 31, w = std::exp(-2 * x * x) - std::exp(-8);
    all += w * 2 / 31;
    middle += w * std::clamp(.5 - x, 0.0, 2.0 / 31);
  }
  return middle / all;
}

/// The floor's radiance under the first of four rows as Mitsuba blends it, from 1 at the pole to 0
/// at 60 degrees.
const double blended_row = .5 - 3 * std::sqrt(3.0) / (8 * std::numbers::pi);

}  // namespace

std::vector<Convention> mitsuba_rows() {
  using namespace known;
  constexpr Peer mitsuba = Peer::mitsuba;
  return {
      {mitsuba, "point light", point,
       "s['l'] = {'type': 'point', 'position': [0, 0, .5], 'intensity': 1.}", 1,
       "`intensity` is ours, power per steradian"},
      {mitsuba, "spot light, on its axis", point,
       "s['l'] = {'type': 'spot', 'intensity': 1.,\n"
       "  'to_world': mi.ScalarTransform4f().look_at([0, 0, .5], [0, 0, 0], [0, 1, 0])}",
       1,
       "`intensity` is that of a point light in its place; ours has no spot, so no equal outside its full "
       "beam"},
      {mitsuba, "directional light", far_point,
       "s['l'] = {'type': 'directional', 'direction': [0, 0, -1], 'irradiance': 1.}", 1,
       "`irradiance` E is a point light of intensity E D² at the distance D, 1e4 times the scene's size, against the direction; give it a "
       "`direction`, since a scale in `to_world` counts"},
      {mitsuba, "sphere as a light", sphere,
       "s['l'] = {'type': 'sphere', 'center': [0, 0, .5], 'radius': .1,\n"
       "  'emitter': {'type': 'area', 'radiance': 1.}}",
       1, "`radiance` is ours"},
      {mitsuba, "disk as a light", disk,
       "s['l'] = {'type': 'disk', 'flip_normals': True, 'emitter': {'type': 'area', 'radiance': 1.},\n"
       "  'to_world': mi.ScalarTransform4f().translate([0, 0, .5]).scale(.1)}",
       1, "`radiance` is ours"},
      {mitsuba, "rectangle as a light", square,
       "s['l'] = {'type': 'rectangle', 'flip_normals': True, 'emitter': {'type': 'area', 'radiance': 1.},\n"
       "  'to_world': mi.ScalarTransform4f().translate([0, 0, .5]).scale(.1)}",
       1, "`radiance` is ours"},
      {mitsuba, "a light's back", light_back, "", 1, "black, as ours"},
      {mitsuba, "sphere turned inside out", inside_sphere,
       "s['l'] = {'type': 'sphere', 'radius': .9, 'flip_normals': True,\n"
       "  'emitter': {'type': 'area', 'radiance': 1.}}",
       1, "`flip_normals` is our `flipNormals`"},
      {mitsuba, "constant sky", environment, "s['l'] = {'type': 'constant', 'radiance': 1.}", 1,
       "`radiance` is ours"},
      {mitsuba, "light of `<spectrum value=\"1\"/>`", spectrum,
       "s['shape0']['emitter'] = mi.load_string('<emitter type=\"area\" version=\"3.0.0\">"
       "<spectrum name=\"radiance\" value=\"1\"/></emitter>')",
       1,
       "not white in an RGB variant: reddish, and as ours in files of 2.x and 3.x; write `<rgb>`"},
      {mitsuba, "map: where its columns are", map_y_up,
       "s['l'] = {'type': 'envmap', 'filename': task['maps'] + 'columns.exr'}", 1,
       "as ours: y up, middle at +z, +x a quarter from the left"},
      {mitsuba, "map of four rows: light of the first", first_row,
       "s['l'] = {'type': 'envmap', 'filename': task['maps'] + 'first_row.exr'}",
       (.1 + .9 * blended_row) / .55, "the first and last rows lie on the poles; use many rows"},
      {mitsuba, "map made finer", first_row,
       "import mitsuba_peer\n"
       "rows = [1. if row == 0 else .1 for row in range(4) for _ in range(24)]\n"
       "s['l'] = mitsuba_peer.envmap_json({'width': 8, 'height': 4, 'radiance': rows,\n"
       "  'x': [1, 0, 0], 'y': [0, 1, 0], 'z': [0, 0, 1]})",
       1, "each texel as 8 x 32 smaller ones (`bench/peers/mitsuba_peer.py`)"},
      {mitsuba, "reflectance that is not given", default_grey,
       "s['shape0']['bsdf'] = {'type': 'diffuse'}\ns['l'] = {'type': 'constant'}", 1,
       "1/2 in both"},
      {mitsuba, "a diffuse surface's back", back, "s['l'] = {'type': 'constant'}", 0,
       "black; ours here is `twosided`"},
      {mitsuba, "the same, `twosided`", back,
       "s['shape0']['bsdf'] = {'type': 'twosided', 'bsdf': s['shape0']['bsdf']}\n"
       "s['l'] = {'type': 'constant'}",
       1, "`twosided` as ours"},
      {mitsuba, "two mirrors", periscope,
       "for name in ('shape0', 'shape1'):\n"
       "  s[name]['bsdf'] = {'type': 'twosided', 'bsdf': {'type': 'conductor', 'material': 'none'}}",
       1, "`conductor` with `material` `none`"},
      {mitsuba,
       "block of glass, index 1.5",
       slab,
       "for i in range(6): s[f'shape{i}']['bsdf'] = {'type': 'dielectric', 'int_ior': 1.5, 'ext_ior': 1.}",
       1,
       "`int_ior`, `ext_ior`",
       {},
       256},
      {mitsuba,
       "glass without an index",
       default_slab,
       "for i in range(6): s[f'shape{i}']['bsdf'] = {'type': 'dielectric'}",
       1,
       "bk7 in air, as ours",
       {},
       256},
      {mitsuba,
       "thin pane",
       slab,
       "for i in range(1, 6): del s[f'shape{i}']\n"
       "s['shape0'] = {'type': 'rectangle', 'bsdf': {'type': 'thindielectric', 'int_ior': 1.5, 'ext_ior': 1.}}",
       1,
       "`thindielectric` on one rectangle is our block of glass, both faces of it",
       {},
       256},
      {mitsuba,
       "light inside glass",
       light_inside,
       "for i in range(6): s[f'shape{i}']['bsdf'] = {'type': 'dielectric', 'int_ior': 1.5, 'ext_ior': 1.}",
       1,
       "radiance divided by the index squared where it leaves, as ours",
       {},
       256},
      {mitsuba, "Phong's exponent as a roughness", phong,
       "s['shape0']['bsdf'] = {'type': 'roughconductor', 'material': 'none', 'distribution': 'beckmann',\n"
       "  'alpha': 1 / math.sqrt(2 * (30 + 2))}\n"
       "s['l'] = {'type': 'point', 'position': [0, 0, .5], 'intensity': 1.}",
       1,
       "there is no `phong`; `alpha` = 1 / √(2 (n + 2)) has the lobe's height at normal "
       "incidence, not its shape"},
      {mitsuba, "reflections without end", furnace, "", 1,
       "roulette from `rr_depth` 5 on is unbiased"},
      {mitsuba, "at most three segments", three_segments, "", 1, "`max_depth` is our `maxDepth`"},
      {mitsuba, "field of view, upright image", framed(4, 8, "x"),
       "del s['sensor']['fov_axis']\ns['sensor']['fov'] = 60", 1, "along x, as ours"},
      {mitsuba, "first rows of the array", halves, "", 1, "top, as in our EXR"},
      {mitsuba, "line one pixel wide, box filter", stripe, "", 1,
       "`rfilter` `box` is our only filter"},
      {mitsuba,
       "the same, default filter",
       stripe,
       "del s['sensor']['film']['rfilter']",
       gaussian_middle(),
       "a Gaussian of deviation 1/2, a table of 31 steps to radius 2",
       {},
       1024},
      {mitsuba, "a file of .1, default precision", tenth,
       "s['sensor']['film']['component_format'] = 'float16'\n"
       "def value(image):\n"
       "  scene = mi.load_dict(s)\n"
       "  mi.render(scene, spp=4)\n"
       "  scene.sensors()[0].film().write(task['output'])\n"
       "  return numpy.array(mi.Bitmap(task['output']), dtype=numpy.float64).mean()",
       1638.0 / 16384 / .1, "halves: up to 1/2048 off; set `component_format` to `float32`"},
  };
}

}  // namespace bench
