#include "known.h"

#include <cmath>

namespace bench {

std::vector<Convention> luxcore_rows() {
  using namespace known;
  constexpr Peer luxcore = Peer::luxcore;
  const std::string no_roulette = "set_(path_russianroulette_depth=1000)\n";
  const std::string default_depth =
      "for name in ('pathdepth.total', 'pathdepth.diffuse', 'pathdepth.glossy', 'pathdepth.specular', "
      "'maxdepth'):\n  settings.Delete('path.' + name)";
  const std::string camera =
      "add('camera', type='perspective', lookat_orig=[0, 0, .75], lookat_target=[0, 0, 0], up=[0, 1, 0],\n"
      "  autovolume_enable=False, cliphither=1e-6, fieldofview=";
  return {
      {luxcore, "point light", point,
       "add('lights.l', type='point', position=[0, 0, .5], color=[1.] * 3, gain=[4 * math.pi] * 3)",
       1, "gain times color = 4 π I"},
      {luxcore, "spot light, on its axis", point,
       "add('lights.l', type='spot', position=[0, 0, .5], target=[0, 0, 0], color=[1.] * 3, gain=[1.] * 3)",
       1, "gain times color = I, unlike a point light's"},
      {luxcore, "`sharpdistant`", far_point,
       "add('lights.l', type='sharpdistant', direction=[0, 0, -1], color=[1.] * 3)", 1,
       "color is irradiance"},
      {luxcore, "`distant`, theta 5", cone,
       "add('lights.l', type='distant', direction=[0, 0, -1], theta=5., color=[1.] * 3)", 1,
       "color is the radiance within theta degrees of the direction"},
      {luxcore, "`sphere`", sphere,
       "add('lights.l', type='sphere', position=[0, 0, .5], radius=.1, color=[1.] * 3,\n"
       "  gain=[4 * math.pi * (math.pi * .1**2)] * 3)",
       1, "gain times color = 4 π² r² L"},
      {luxcore, "a light's back", light_back,
       "add('materials.m0', type='matte', kd=[0.] * 3, emission=[1.] * 3)", 1, "black, as ours"},
      {luxcore, "a light's front", tenth,
       "add('materials.m0', type='matte', kd=[0.] * 3, emission=[.1] * 3)", 1,
       "emission is a radiance"},
      {luxcore, "constant sky", environment,
       "add('lights.l', type='constantinfinite', color=[1.] * 3)", 1, "color is a radiance"},
      {luxcore, "map: where its columns are", map_z_up,
       "add('lights.l', type='infinite', file=task['maps'] + 'columns.exr', gamma=1., transformation=\n"
       "  [-1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.])",
       1, "z up, and mirrored: with x reversed its x, y, z are our map's +z, +x, +y"},
      {luxcore, "map of 1/2, default gamma", grey_map,
       "add('lights.l', type='infinite', file=task['maps'] + 'grey.exr')", std::pow(.5, 1.2),
       "values of an EXR, too, are raised to 2.2 without gamma 1"},
      {luxcore, "the same, gamma 1", grey_map,
       "add('lights.l', type='infinite', file=task['maps'] + 'grey.exr', gamma=1.)", 1,
       "as they are"},
      {luxcore, "reflectance that is not given", default_grey,
       "add('materials.m0', type='matte')\nadd('lights.l', type='constantinfinite', color=[1.] * 3)",
       1.5, ".75 in LuxCore, 1/2 in ours"},
      {luxcore, "a diffuse surface's back", back,
       "add('materials.m0', type='matte', kd=[.5] * 3)\n"
       "add('lights.l', type='constantinfinite', color=[1.] * 3)",
       1, "as ours with `twosided`"},
      {luxcore, "two mirrors", periscope, "add('materials.m0', type='mirror', kr=[1.] * 3)", 1,
       "`mirror`; nothing is clamped by default"},
      {luxcore,
       "block of glass, index 1.5",
       slab,
       "add('materials.m0', type='glass', kr=[1.] * 3, kt=[1.] * 3, interiorior=1.5, exteriorior=1.)",
       1,
       "`interiorior`, `exteriorior`",
       {},
       256},
      {luxcore,
       "glass without an index",
       slab,
       "add('materials.m0', type='glass', kr=[1.] * 3, kt=[1.] * 3)",
       1.04 / .96,
       "the index is 1: nothing is reflected",
       {},
       256},
      {luxcore,
       "light inside glass",
       light_inside,
       "add('materials.m0', type='glass', kr=[1.] * 3, kt=[1.] * 3, interiorior=1.5, exteriorior=1.)",
       1,
       "radiance divided by the index squared where it leaves, as ours",
       {},
       256},
      {luxcore, "Phong's exponent as a roughness", phong,
       "a = 1 / math.sqrt(2 * (30 + 2))\n"
       "add('materials.m0', type='glossy2', kd=[0.] * 3, ks=[1.] * 3, uroughness=a, vroughness=a)\n"
       "add('lights.l', type='point', position=[0, 0, .5], color=[4 * math.pi] * 3)",
       1,
       "`glossy2`: uroughness = vroughness = 1 / √(2 (n + 2)) has the lobe's height at normal "
       "incidence, not its shape"},
      {luxcore, "reflections without end", furnace,
       no_roulette + "set_(path_pathdepth_total=24, path_pathdepth_diffuse=24)", 1,
       "with roulette off; 24 segments leave 6e-8"},
      {luxcore, "the same, default roulette", furnace, "", 1,
       "from the third bounce on, `path.russianroulette.depth`",
       "paths that roulette may end carry too much light; put it off by a large depth"},
      {luxcore, "the same, default depth, roulette off", furnace, no_roulette + default_depth,
       (2 - std::pow(.5, 3)) / 2, "4 diffuse segments of 6"},
      {luxcore, "at most three segments", three_segments, no_roulette, 1,
       "`path.pathdepth.total` = maxDepth, from 2 on (1 is as 2)"},
      {luxcore, "field of view, upright image", framed(4, 8, "larger"), camera + "60.)", 1,
       "`fieldofview` is along the larger axis; ours with `fovAxis` `larger`"},
      {luxcore, "first rows of `GetOutputFloat`", halves,
       "value = lambda image: image[::-1][:4].mean()", 3,
       "bottom; its EXR files have the top first"},
      {luxcore, "line one pixel wide, no filter", stripe, "", 1,
       "`film.filter.type` `NONE` is our box"},
      {luxcore,
       "the same, default filter",
       stripe,
       "settings.Delete('film.filter.type')",
       blackman_harris_middle(2),
       "Blackman-Harris of radius 2 pixels",
       {},
       1024},
      {luxcore, "no filter: the fifth row of eight", fifth_row, camera + "53.13010235415598)",
       1 / 3., "without a filter all is one row too low"},
      {luxcore, "the same, window moved", fifth_row, "", 1,
       "`screenwindow` moved by a row (`bench/peers/luxcore_peer.py`)"},
      {luxcore, "image for the display", tenth,
       "settings.Delete('film.imagepipelines.0.0.type')\n"
       "extra['output'] = pyluxcore.FilmOutputType.RGB_IMAGEPIPELINE",
       10 * 118 / 255. * std::pow(1.25, 1 / 2.2),
       "by default exposed so that any constant image becomes .512, then gamma 2.2; the output `RGB` "
       "is radiance"},
  };
}

}  // namespace bench
