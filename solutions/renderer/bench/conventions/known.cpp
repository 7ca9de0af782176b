#include "known.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace bench::known {
namespace {

using std::numbers::pi;

std::string camera(std::string_view from, std::string_view to, std::string_view up,
                   std::string_view fov = "<float name='fov' value='.02'/>", int width = 8,
                   int height = 8) {
  return fmt::format(
      "<sensor type='perspective'>{}<transform name='toWorld'><lookat origin='{}' target='{}' "
      "up='{}'/></transform><film type='hdrfilm'><integer name='width' value='{}'/><integer "
      "name='height' value='{}'/><rfilter type='box'/></film></sensor>",
      fov, from, to, up, width, height);
}

/// A horizontal rectangle with its front up.
std::string card(double x, double y, double z, double half_x, double half_y,
                 std::string_view inside) {
  return fmt::format(
      "<shape type='rectangle'><transform name='toWorld'><scale x='{}' y='{}' z='1'/><translate "
      "x='{}' y='{}' z='{}'/></transform>{}</shape>",
      half_x, half_y, x, y, z, inside);
}

std::string emits(double radiance) {
  return fmt::format("<emitter type='area'><rgb name='radiance' value='{}'/></emitter>", radiance);
}

std::string grey(double reflectance) {
  return fmt::format("<bsdf type='diffuse'><rgb name='reflectance' value='{}'/></bsdf>",
                     reflectance);
}

std::string light_at(double height, double intensity) {
  return fmt::format(
      "<emitter type='point'><point name='position' x='0' y='0' z='{}'/><rgb name='intensity' "
      "value='{}'/></emitter>",
      height, intensity);
}

std::string ball(double height, double radius, std::string_view inside) {
  return fmt::format(
      "<shape type='sphere'><point name='center' x='0' y='0' z='{}'/><float name='radius' "
      "value='{}'/>{}</shape>",
      height, radius, inside);
}

const std::string sky = "<emitter type='constant'/>";
const std::string flipped = "<boolean name='flipNormals' value='true'/>";
const std::string wide = "<float name='fov' value='53.13010235415598'/>";  // 2 atan(1/2)
const std::string slanted = camera("0.6, 0, 0.6", "0, 0, 0", "0, 0, 1");
const std::string above = camera("0, 0, 0.75", "0, 0, 0", "0, 1, 0");
// Besides the line where two triangles of a rectangle meet.
const std::string off_middle = camera("0.05, 0.02, 0.75", "0.05, 0.02, 0", "0, 1, 0");
const std::string above_wide = camera("0, 0, 0.75", "0, 0, 0", "0, 1, 0", wide);
const std::string floor = slanted + card(.1, 0, 0, .5, .5, grey(1));

double of_square() {
  const double x = .2 / std::sqrt(1.04);
  return 4 / pi * x * std::atan(.2 / std::sqrt(1.04));
}

std::string two_sided(std::string_view bsdf) {
  return fmt::format("<bsdf type='twosided'>{}</bsdf>", bsdf);
}

std::string closed_cube(int depth) {
  return fmt::format("<integrator type='path'><integer name='maxDepth' value='{}'/></integrator>",
                     depth) +
         camera("0, 0, 0", "1, 0, 0", "0, 0, 1", wide) +
         "<shape type='cube'><transform name='toWorld'><scale value='0.5'/></transform>" + flipped +
         grey(.5) + emits(1) + "</shape>";
}

std::string tilted(double x, double angle, std::string_view bsdf) {
  return fmt::format(
      "<shape type='rectangle'><transform name='toWorld'><scale value='0.1'/><rotate y='1' "
      "angle='{}'/><translate x='{}'/></transform>{}</shape>",
      angle, x, bsdf);
}

std::string mirrors(std::string_view bsdf) {
  return tilted(0, 45, bsdf) + tilted(.5, -45, bsdf) +
         card(.5, 0, .6, .2, .2, flipped + emits(100));
}

std::string block(std::string_view bsdf) {
  return fmt::format(
      "<shape type='cube'><transform name='toWorld'><scale value='0.2'/></transform>{}</shape>",
      bsdf);
}

/// A block with a light below or inside it.
std::string lit_block(std::string_view bsdf, bool inside) {
  return block(bsdf) +
         (inside ? card(0, 0, -.1, .1, .1, emits(1)) : card(0, 0, -.3, .4, .4, emits(1)));
}

const std::string glass =
    "<bsdf type='dielectric'><float name='intIOR' value='1.5'/><float name='extIOR' "
    "value='1'/></bsdf>";

/// Of a block, with all reflections inside it.
double transmittance(double index) {
  const double r = std::pow((index - 1) / (index + 1), 2);
  return (1 - r) / (1 + r);
}

std::string map(std::string_view file, std::string_view turn = "") {
  return fmt::format("<emitter type='envmap'><string name='filename' value='{}'/>{}</emitter>",
                     file, turn);
}

// Our map's +z, +x, +y along x, y, z.
const std::string z_up =
    "<transform name='toWorld'><matrix value='0 0 1  1 0 0  0 1 0'/></transform>";

}  // namespace

const Known point{floor, light_at(.5, 1), 4 / pi};
const Known far_point{floor, light_at(1000, 1e6), 1 / pi};
const Known sphere{floor, ball(.5, .1, emits(1)), .04};
const Known disk{floor,
                 "<shape type='disk'><transform name='toWorld'><rotate x='1' angle='180'/><scale "
                 "value='0.1'/><translate z='0.5'/></transform>" +
                     emits(1) + "</shape>",
                 .01 / .26};
const Known square{floor, card(0, 0, .5, .1, .1, flipped + emits(1)), of_square()};
const Known environment{slanted + card(.1, 0, 0, .5, .5, grey(.3)), sky, .3};
const Known cone{floor, ball(100, 100 * std::sin(pi / 36), emits(1)),
                 std::pow(std::sin(pi / 36), 2)};
const Known back{slanted, card(.1, 0, 0, .5, .5, flipped + two_sided(grey(.5))) + sky, .5,
                 card(.1, 0, 0, .5, .5, flipped + grey(.5))};
const Known default_grey{slanted, card(.1, 0, 0, .5, .5, "<bsdf type='diffuse'/>") + sky, .5,
                         card(.1, 0, 0, .5, .5, grey(1))};
const Known light_back{slanted + card(.1, 0, 0, .5, .5, flipped + emits(1)), "", 0};
const Known light_both{slanted + card(.1, 0, 0, .5, .5, flipped + emits(1)),
                       card(.1, 0, 0, .5, .5, emits(1)), 1};
const Known near_card{above + card(0, 0, .7, .4, .4, emits(1)), "", 1};
const Known inside_sphere{
    camera("0, 0.5, 0.3", "0, 0, 0", "0, 0, 1") + card(0, 0, 0, .25, .25, grey(.3)),
    ball(0, .9, flipped + emits(1)), .3};
const Known furnace{closed_cube(-1), "", 2};
const Known three_segments{closed_cube(3), "", 1.75};
const Known periscope{above, mirrors(two_sided("<bsdf type='conductor'/>")), 100,
                      mirrors(two_sided(grey(1)))};
const Known slab{off_middle, lit_block(glass, false), transmittance(1.5),
                 lit_block(grey(1), false)};
const Known default_slab{off_middle, lit_block("<bsdf type='dielectric'/>", false),
                         transmittance(1.5046 / 1.000277), lit_block(grey(1), false)};
const Known light_inside{off_middle, lit_block(glass, true), .96 / 2.25, lit_block(grey(1), true)};
const Known stripe{
    above_wide + card(-.046875, 0, 0, .046875, .45, emits(1)), "", 1, "", {3, 2, 4, 6}};
const Known quarter{
    above_wide + card(-.08203125, 0, 0, .01171875, .45, emits(1)), "", .25, "", {3, 0, 4, 8}};
const Known halves{
    above_wide + card(0, .25, 0, .5, .25, emits(1)) + card(0, -.25, 0, .5, .25, emits(3)),
    "",
    1,
    "",
    {0, 0, 8, 4}};
const Known fifth_row{halves.shared, "", 3, "", {0, 4, 8, 5}};
const Known phong{above,
                  card(.1, 0, 0, .5, .5,
                       "<bsdf type='phong'><rgb name='diffuseReflectance' value='0'/><rgb "
                       "name='specularReflectance' value='1'/><float name='exponent' "
                       "value='30'/></bsdf>") +
                      light_at(.5, 1),
                  32 / (2 * pi) * 4, card(.1, 0, 0, .5, .5, grey(1))};
const Known map_y_up{camera("0, 0, 0", "0.9238795325, 0, 0.3826834324", "0, 1, 0"),
                     map("columns.exr"), 3};
const Known map_z_up{camera("0, 0, 0", "0.3826834324, 0.9238795325, 0", "0, 0, 1"),
                     map("columns.exr", z_up), 3};
const Known first_row{camera("0.6, 0.6, 0", "0, 0, 0", "0, 1, 0") +
                          "<shape type='rectangle'><transform name='toWorld'><scale "
                          "value='0.5'/><rotate x='1' angle='-90'/></transform>" +
                          grey(1) + "</shape>",
                      map("first_row.exr"), .55};
const Known first_row_z_up{floor, map("first_row.exr", z_up), .55};
const Known grey_map{slanted, map("grey.exr"), .5};
const Known spectrum{
    above,
    card(.1, 0, 0, .5, .5, "<emitter type='area'><spectrum name='radiance' value='1'/></emitter>"),
    no_closed_form, card(.1, 0, 0, .5, .5, emits(1))};
const Known tenth{above + card(.1, 0, 0, .5, .5, emits(.1)), "", .1};

Known framed(int width, int height, std::string_view axis) {
  const std::string fov =
      fmt::format("<float name='fov' value='60'/><string name='fovAxis' value='{}'/>", axis);
  const bool x = axis == "x" || (axis == "larger") == (width > height);
  const double side = 1.5 / std::sqrt(3.0),
               other = side * (x ? height / double(width) : width / double(height));
  return {camera("0, 0, 0.75", "0, 0, 0", "0, 1, 0", fov, width, height) +
              card(0, 0, 0, .2, .2, emits(1)),
          "",
          .16 / (side * other),
          "",
          {0, 0, width, height}};
}

double blackman_harris_middle(double radius) {
  const double a[] = {.35875, .48829, .14128, .01168};
  const auto up_to = [&](double x) {
    const double t = 2 * pi * (x / (2 * radius) + .5);
    return a[0] * t - a[1] * std::sin(t) + a[2] * std::sin(2 * t) / 2 - a[3] * std::sin(3 * t) / 3;
  };
  return (up_to(.5) - up_to(-.5)) / (2 * pi * a[0]);
}

}  // namespace bench::known
