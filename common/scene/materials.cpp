#include "scene/materials.h"

#include "scene/needs.h"
#include "scene/text.h"

#include <array>
#include <utility>

namespace carlo {
namespace {

// Refractive indices at 589 nm (Bass et al., "Handbook of Optics"; the values of Mitsuba 0.6).
constexpr std::array<std::pair<std::string_view, float>, 9> media = {{
    {"vacuum", 1.0f},
    {"air", 1.000277f},
    {"water", 1.333f},
    {"water ice", 1.31f},
    {"fused quartz", 1.458f},
    {"pyrex", 1.47f},
    {"acrylic glass", 1.49f},
    {"bk7", 1.5046f},
    {"diamond", 2.419f},
}};

float refractive_index(Properties& bsdf, const std::string& name, float otherwise) {
  if (bsdf.is_string(name)) {
    const std::string medium = *bsdf.string(name);
    std::vector<std::string> known;
    for (const auto& [key, ior] : media) {
      if (key == medium) return ior;
      known.emplace_back(key);
    }
    fail(bsdf.at(name), "{} names no medium: {}{}", name, in_quotes(medium),
         suggest(medium, known));
  }
  const float ior = bsdf.number(name).value_or(otherwise);
  if (!(ior > 0)) fail(bsdf.at(name), "{} must be > 0, got {}", name, ior);
  return ior;
}

Diffuse parse_diffuse(Properties& bsdf) {
  return {bsdf.colour("reflectance", 1).value_or(Rgb(0.5f))};
}

Phong parse_phong(Properties& bsdf) {
  Phong phong;
  phong.kd = bsdf.colour("diffuseReflectance", 1).value_or(Rgb(0.5f));
  phong.ks = bsdf.colour("specularReflectance", 1).value_or(Rgb(0.2f));
  phong.exponent = bsdf.number("exponent").value_or(30.0f);
  if (!(phong.exponent >= 0)) {
    fail(bsdf.at("exponent"), "exponent must be >= 0, got {}", phong.exponent);
  }
  for (int i = 0; i < 3; ++i) {
    const float sum = phong.kd[i] + phong.ks[i];
    // 0.3 + 0.7 in float may exceed 1 by a rounding.
    if (sum <= 1.000001f) continue;
    fail(bsdf.at("specularReflectance"),
         "diffuseReflectance + specularReflectance must be <= 1 (energy is not created), got {} in "
         "{}",
         sum,
         std::array{"the red channel", "the green channel", "the blue channel"}.at(
             static_cast<std::size_t>(i)));
  }
  return phong;
}

Mirror parse_conductor(Properties& bsdf) {
  const auto material = bsdf.string("material");
  if (material != "none") {
    fail(bsdf.at("material"),
         "only <string name=\"material\" value=\"none\"/>, a perfect mirror, is supported, got {}",
         material ? in_quotes(*material) : "nothing");
  }
  return {bsdf.colour("specularReflectance", 1).value_or(Rgb(1))};
}

Dielectric parse_dielectric(Properties& bsdf) {
  const float inside = refractive_index(bsdf, "intIOR", 1.5046f);
  return {inside, refractive_index(bsdf, "extIOR", 1.000277f)};
}

}  // namespace

void Materials::define(const XmlElement& bsdf) {
  const Material material = parse(bsdf);
  if (bsdf.find("id") == nullptr) {
    fail(bsdf.at, "a <bsdf> outside a <shape> needs an id, or nothing can use it");
  }
  named_[bsdf.get("id").value].material = material;
}

std::uint32_t Materials::of_shape(const Properties& shape, bool emits) {
  const XmlElement* bsdf = shape.object("bsdf");
  const XmlElement* ref = shape.object("ref");
  if (bsdf != nullptr && ref != nullptr) {
    fail(ref->at, "the shape has a <bsdf> already, got a <ref> too");
  }
  if (bsdf == nullptr && ref == nullptr) return add({Diffuse{Rgb(emits ? 0.0f : 0.5f)}, false});
  Entry own;
  Entry* entry = &own;
  if (ref != nullptr) {
    entry = &resolve(*ref);
  } else {
    own.material = parse(*bsdf);
    if (const XmlAttribute* id = bsdf->find("id")) entry = &(named_[id->value] = own);
  }
  if (entry->index < 0) entry->index = add(entry->material);
  entry->used = true;
  return static_cast<std::uint32_t>(entry->index);
}

std::vector<std::string> Materials::notes() const {
  std::vector<std::string> out;
  for (const auto& [id, entry] : named_) {
    if (!entry.used) out.push_back(fmt::format("no shape uses the bsdf {}", in_quotes(id)));
  }
  return out;
}

Material Materials::parse(const XmlElement& bsdf) {
  const XmlAttribute& type = bsdf.get("type");
  if (type.value == "twosided") return parse_two_sided(bsdf);
  Properties properties(bsdf);
  Material material;
  if (type.value == "diffuse") {
    material.model = parse_diffuse(properties);
  } else if (type.value == "phong") {
    material.model = parse_phong(properties);
  } else if (type.value == "conductor") {
    material.model = parse_conductor(properties);
  } else if (type.value == "dielectric") {
    material.model = parse_dielectric(properties);
  } else {
    fail(type.value_at, "bsdf {} is not supported{}", in_quotes(type.value),
         suggest(type.value, {"diffuse", "phong", "twosided", "conductor", "dielectric"}));
  }
  properties.finish();
  return material;
}

Material Materials::parse_two_sided(const XmlElement& bsdf) {
  const Properties properties(bsdf, {"bsdf", "ref"});
  properties.finish();
  const XmlElement* inner = properties.object("bsdf");
  const XmlElement* ref = properties.object("ref");
  if ((inner != nullptr) == (ref != nullptr)) {
    fail(ref != nullptr ? ref->at : bsdf.at, "<bsdf type=\"twosided\"> needs one bsdf inside");
  }
  Entry* entry = ref != nullptr ? &resolve(*ref) : nullptr;
  Material material = entry != nullptr ? entry->material : parse(*inner);
  const Position at = ref != nullptr ? ref->at : inner->at;
  if (material.two_sided) fail(at, "twosided inside twosided");
  if (passes_light(material)) {
    fail(at, "a dielectric cannot be twosided: light passes through it");
  }
  if (entry != nullptr) {
    entry->used = true;
  } else if (const XmlAttribute* id = inner->find("id")) {
    named_[id->value] = {material, -1, true};
  }
  material.two_sided = true;
  return material;
}

Materials::Entry& Materials::resolve(const XmlElement& ref) {
  ref.allow_only({"id"});
  if (!ref.children.empty()) fail(ref.children.front().at, "<ref> takes no elements inside");
  const XmlAttribute& id = ref.get("id");
  const auto found = named_.find(id.value);
  if (found != named_.end()) return found->second;
  if (const std::string* kind = ids_.kind(id.value)) {
    fail(id.value_at, "the id {} names a <{}>, expected a <bsdf>", in_quotes(id.value), *kind);
  }
  std::vector<std::string> known;
  for (const auto& [name, entry] : named_)
    known.push_back(name);
  fail(id.value_at, "no <bsdf> above has the id {}{}", in_quotes(id.value),
       suggest(id.value, known));
}

std::uint32_t Materials::add(const Material& material) {
  list_.push_back(material);
  return static_cast<std::uint32_t>(list_.size() - 1);
}

}  // namespace carlo
