#include "scene/plugins.h"

#include "scene/checks.h"
#include "scene/values.h"

#include <algorithm>
#include <initializer_list>

namespace carlo {
namespace {

constexpr auto none = Treatment::none, noted = Treatment::noted, refused = Treatment::refused;
constexpr auto any_number = is<number_value>, any_integer = is<integer_value>,
               any_boolean = is<boolean_value>, any_text = is<text_value>,
               a_point = is<point_value>;

using Rules = std::vector<Rule>;

Rules operator+(Rules a, const Rules& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Rule to_world{"toWorld", a_transform};

// Cameras -----------------------------------------------------------------------------------------

Rules sensor_rules() {
  return {{"fov", an_angle, Treatment::read, "", "float"},
          {"fovAxis", is<fov_axis_value>},
          to_world,
          {"nearClip", above_zero, none},  // checked in sensor.h
          {"farClip", above_zero, none},
          {"focusDistance", any_number, none},
          {"shutterOpen", any_number, none},
          {"shutterClose", any_number, none},
          {"focalLength", anything, refused, "give fov"},
          {"principalPointOffsetX", only_zero, none},
          {"principalPointOffsetY", only_zero, none}};
}

Rules film_rules() {
  return {{"width", a_count},
          {"height", a_count},
          {"banner", any_boolean, none},
          {"pixelFormat", any_text, none},
          {"componentFormat", any_text, none},
          {"fileFormat", any_text, none},
          {"attachLog", any_boolean, none},
          {"highQualityEdges", any_boolean, none},
          {"sampleBorder", any_boolean, none},
          {"compensate", any_boolean, none},
          {"cropWidth", any_integer, none},  // checked in sensor.cpp

          {"cropHeight", any_integer, none},
          {"cropOffsetX", no_pixels, none},
          {"cropOffsetY", no_pixels, none}};
}

const Rules tone_mapping = {{"gamma", any_number, none},
                            {"exposure", any_number, none},
                            {"tonemapMethod", any_text, none},
                            {"key", any_number, none},
                            {"burn", any_number, none}};

const std::string_view other_numbers = "it changes the noise, not the expected image";

Rules sampler_rules() {
  return {{"sampleCount", a_count},
          {"seed", any_integer, noted, other_numbers},
          {"scramble", any_integer, noted, other_numbers},
          {"dimension", any_integer, noted, other_numbers},
          {"jitter", only_true, none}};
}

std::vector<Plugin> camera_plugins() {
  std::vector<Plugin> out = {
      {"integrator",
       "path",
       "scene",
       {},
       {{"maxDepth", a_depth},
        {"rrDepth", any_integer, noted,
         "the renderer plays Russian roulette by a rule of its own; the mean is the same"},
        {"hideEmitters", only_false, none},
        {"strictNormals", any_boolean, none},
        {"block_size", any_integer, none},
        {"samples_per_pass", any_integer, none}}},
      {"sensor", "perspective", "scene", {"film", "sampler"}, sensor_rules()},
      {"film", "hdrfilm", "sensor", {"rfilter"}, film_rules()},
      {"film",
       "ldrfilm",
       "sensor",
       {"rfilter"},
       film_rules() + tone_mapping,
       "hdrfilm",
       "the EXR holds radiances, the PNG is sRGB without tone mapping"},
      {"rfilter", "box", "film", {}, {{"radius", only_half, none}}}};
  for (const char* type : {"independent", "stratified", "sobol"})
    out.push_back({"sampler", type, "sensor", {}, sampler_rules()});
  for (const char* type : {"ldsampler", "halton", "hammersley", "multijitter", "orthogonal"})
    out.push_back({"sampler", type, "sensor", {}, sampler_rules(), "sobol", other_numbers});
  return out;
}

// Materials ---------------------------------------------------------------------------------------

std::vector<Plugin> bsdf_plugins() {
  return {{"bsdf",
           "diffuse",
           "",
           {},
           {{"reflectance", a_reflectance}, {"diffuseReflectance", a_reflectance}}},
          {"bsdf",
           "phong",
           "",
           {},
           {{"diffuseReflectance", a_reflectance},
            {"specularReflectance", a_reflectance},
            {"exponent", zero_or_above}}},
          {"bsdf",
           "conductor",
           "",
           {},
           {{"material", only_none}, {"specularReflectance", a_reflectance}}},
          {"bsdf",
           "dielectric",
           "",
           {},
           {{"intIOR", an_ior},
            {"extIOR", an_ior},
            {"specularReflectance", only_one, none},
            {"specularTransmittance", only_one, none}}},
          {"bsdf", "twosided", "", {"bsdf", "ref"}, {}}};
}

// Shapes ------------------------------------------------------------------------------------------

const Rules any_shape = {to_world, {"flipNormals", any_boolean}};
const std::vector<std::string_view> on_a_shape = {"bsdf", "ref", "emitter"};

std::vector<Plugin> shape_plugins() {
  const Rules file = {{"filename", any_text, Treatment::read, "", "string"},
                      {"faceNormals", any_boolean},
                      {"flipTexCoords", any_boolean, none}};
  const Rules ball = {{"center", a_point}, {"radius", above_zero}};
  const Rules sdf = {to_world, {"operation", is<operation_value>}, {"smoothing", zero_or_above}};
  return {
      {"shape", "rectangle", "scene", on_a_shape, any_shape},
      {"shape", "cube", "scene", on_a_shape, any_shape},
      {"shape", "sphere", "scene", on_a_shape, any_shape + ball},
      {"shape", "disk", "scene", on_a_shape, any_shape},
      {"shape", "obj", "scene", on_a_shape, any_shape + file},
      {"shape", "ply", "scene", on_a_shape, any_shape + file + Rules{{"srgb", any_boolean, none}}},
      {"shape",
       "sdf",
       "scene",
       {"bsdf", "ref", "emitter", "shape"},
       sdf + Rules{{"flipNormals", any_boolean}}},
      // Inside an sdf.
      {"shape", "sphere", "sdf", {}, ball + Rules{to_world}},
      {"shape",
       "torus",
       "sdf",
       {},
       {{"majorRadius", above_zero}, {"minorRadius", above_zero}, to_world}},
      {"shape", "roundedBox", "sdf", {}, {{"halfSize", a_point}, {"radius", any_number}, to_world}},
      {"shape",
       "capsule",
       "sdf",
       {},
       {{"p0", a_point}, {"p1", a_point}, {"radius", above_zero}, to_world}},
      {"shape", "gyroid", "sdf", {}, {{"period", above_zero}, {"thickness", above_zero}, to_world}},
      {"shape", "sdf", "sdf", {"shape"}, sdf}};
}

// Lights ------------------------------------------------------------------------------------------

std::vector<Plugin> emitter_plugins() {
  const Rules any = {{"samplingWeight", any_number, noted, other_numbers}};
  const Rules radiance = Rules{{"radiance", an_emission}} + any;
  return {{"emitter", "area", "shape", {}, radiance},
          {"emitter", "constant", "scene", {}, radiance},
          {"emitter",
           "point",
           "scene",
           {},
           Rules{{"position", a_point}, to_world, {"intensity", an_emission}} + any},
          {"emitter",
           "envmap",
           "scene",
           {},
           Rules{{"filename", any_text, Treatment::read, "", "string"},
                 {"scale", above_zero},
                 to_world,
                 {"cache", any_boolean, none}} +
               any}};
}

std::vector<Plugin> all_plugins() {
  std::vector<Plugin> out;
  for (const auto& part : {camera_plugins(), bsdf_plugins(), shape_plugins(), emitter_plugins()})
    out.insert(out.end(), part.begin(), part.end());
  return out;
}

}  // namespace

const std::vector<Plugin>& plugins() {
  static const std::vector<Plugin> all = all_plugins();
  return all;
}

const Plugin* find_plugin(std::string_view element, std::string_view type,
                          std::string_view within) {
  const auto fits = [&](const Plugin& p) {
    return p.element == element && p.type == type && (p.within.empty() || p.within == within);
  };
  const auto found = std::find_if(plugins().begin(), plugins().end(), fits);
  return found == plugins().end() ? nullptr : &*found;
}

const Rule* find_rule(const Plugin& plugin, std::string_view name) {
  // Exporters name everything that they write.
  static const Rule label{"name", any_text, Treatment::none};
  if (name == label.name) return &label;
  const auto found = std::find_if(plugin.rules.begin(), plugin.rules.end(),
                                  [&](const Rule& r) { return r.name == name; });
  return found == plugin.rules.end() ? nullptr : &*found;
}

}  // namespace carlo
