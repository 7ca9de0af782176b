#include "scene/materials.h"

#include "scene/needs.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace carlo {
namespace {

Diffuse parse_diffuse(Properties& bsdf) {
  // Mitsuba 0.6 has two names for this property.
  const auto reflectance = bsdf.reflectance("reflectance");
  const auto other = bsdf.reflectance("diffuseReflectance");
  if (reflectance && other)
    fail(bsdf.at("diffuseReflectance"), "diffuseReflectance is reflectance, which is given too");
  return {reflectance.value_or(other.value_or(Rgb(0.5f)))};
}

Mirror parse_conductor(Properties& bsdf) {
  // The default is copper in Mitsuba 0.6, a perfect mirror in Mitsuba 3.
  if (!bsdf.string("material") && bsdf.dialect() == Dialect::mitsuba06) {
    fail(bsdf.object_at(),
         "only <string name=\"material\" value=\"none\"/>, a perfect mirror, is supported, got "
         "nothing, which is copper");
  }
  return {bsdf.reflectance("specularReflectance").value_or(Rgb(1))};
}

Dielectric parse_dielectric(Properties& bsdf) {
  const float inside = bsdf.ior("intIOR").value_or(1.5046f);
  return {inside, bsdf.ior("extIOR").value_or(1.000277f)};
}

}  // namespace

void Materials::define(const XmlElement& bsdf) {
  const Material material = parse(bsdf);
  if (const XmlAttribute* id = bsdf.find("id")) {
    named_[id->value].material = material;
    return;
  }
  const auto meant = [](const XmlAttribute& a) { return is_near(a.name, "id"); };
  if (std::any_of(bsdf.attributes.begin(), bsdf.attributes.end(), meant))
    return errors_.lose_names();
  fail(bsdf.at, "a <bsdf> outside a <shape> needs an id, or nothing can use it");
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
  std::vector<std::string> out = notes_;
  for (const auto& [id, entry] : named_) {
    if (!entry.used) out.push_back(fmt::format("no shape uses the bsdf {}", in_quotes(id)));
  }
  return out;
}

Material Materials::parse(const XmlElement& bsdf) {
  Material material;
  const XmlAttribute* id = bsdf.find("id");
  open_.push_back(id != nullptr ? id->value : "");
  if (!bsdf.broken) errors_.guard([&] { material = built(bsdf); });
  open_.pop_back();
  return material;
}

Material Materials::built(const XmlElement& bsdf) {
  Properties properties(bsdf);
  const std::string type = properties.type();
  Material material;
  if (type == "twosided") return parse_two_sided(properties);
  if (type == "diffuse") {
    material.model = parse_diffuse(properties);
  } else if (type == "phong") {
    material.model = parse_phong(properties);
  } else if (type == "conductor") {
    material.model = parse_conductor(properties);
  } else if (type == "dielectric") {
    material.model = parse_dielectric(properties);
  } else {
    throw std::logic_error("no material is made of the bsdf " + type);
  }
  properties.finish();
  return material;
}

Phong Materials::parse_phong(Properties& bsdf) {
  Phong phong;
  phong.kd = bsdf.reflectance("diffuseReflectance").value_or(Rgb(0.5f));
  phong.ks = bsdf.reflectance("specularReflectance").value_or(Rgb(0.2f));
  phong.exponent = bsdf.number("exponent").value_or(30.0f);
  if (phong.exponent > sharpest_exponent) {
    notes_.push_back(
        fmt::format("exponent {:g} is clamped to {:g}: their lobes are the same in float",
                    phong.exponent, sharpest_exponent));
    phong.exponent = sharpest_exponent;
  }
  for (int i = 0; i < 3; ++i) {
    const float sum = phong.kd[i] + phong.ks[i];
    // 0.3 + 0.7 in float may exceed 1 by rounding.
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

Material Materials::parse_two_sided(const Properties& bsdf) {
  const XmlElement* inner = bsdf.object("bsdf");
  const XmlElement* ref = bsdf.object("ref");
  if ((inner != nullptr) == (ref != nullptr)) {
    fail(ref != nullptr ? ref->at : bsdf.object_at(),
         "<bsdf type=\"twosided\"> needs one bsdf inside");
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
  const XmlAttribute& id = ref.get("id");
  const auto found = named_.find(id.value);
  if (found != named_.end()) return found->second;
  if (std::find(open_.begin(), open_.end(), id.value) != open_.end())
    fail(id.value_at, "the bsdf {} stands inside itself", in_quotes(id.value));
  // It may be in a file that could not be read, or its name may contain an unknown parameter.
  if (errors_.names_lost() || ref.broken) return unknown_;
  if (const std::string* kind = ids_.kind(id.value)) {
    if (*kind == "bsdf") return unknown_;  // inside a refused element
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

void Ids::declare(const XmlElement& element, SceneErrors& errors) {
  const XmlAttribute* id = element.find("id");
  if (id != nullptr && element.name != "ref" && !element.broken) {
    errors.guard([&] {
      if (id->value.empty()) fail(id->value_at, "an id must not be empty");
      if (!kinds_.emplace(id->value, element.name).second) {
        fail(id->value_at, "the id {} is given twice", in_quotes(id->value));
      }
    });
  }
  for (const XmlElement& child : element.children)
    declare(child, errors);
}

const std::string* Ids::kind(const std::string& id) const {
  const auto found = kinds_.find(id);
  return found == kinds_.end() ? nullptr : &found->second;
}

}  // namespace carlo
