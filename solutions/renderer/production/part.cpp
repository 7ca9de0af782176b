#include "renderer/production/part.h"

#include "course/json/json_fields.h"
#include "support/error.h"

#include <fmt/core.h>

namespace carlo {

static void whole(JsonFields& json, const char* name, std::uint32_t& value) {
  unsigned long number = value;
  json(name, number);
  if (number > 0xFFFFFFFF) json.fail(fmt::format("its {} is {}", name, number));
  value = static_cast<std::uint32_t>(number);
}

static void fields(JsonFields& json, Shard& shard) {
  whole(json, "index", shard.index);
  whole(json, "count", shard.count);
}

static void fields(JsonFields& json, BlockSet& blocks) {
  std::string text = blocks.text();
  json("numbers", text);
  const auto found = BlockSet::from_text(text);
  if (!found) json.fail(fmt::format("they are '{}'", text));
  blocks = *found;
}

static void fields(JsonFields& json, Part& part) {
  json("needs", part.needs);
  json("lamps", part.lamps);
  json("least_light_chance", part.least_light_chance);
  json("shard", part.shard);
  json.as_text("parts", part.parts);
  json("blocks", part.blocks);
  json.as_text("microseconds", part.microseconds);
  json("threads", part.threads);
}

std::string to_text(const Part& part) {
  return json_text(part);
}

Part part_of(const std::string& text, const std::string& place) {
  auto part = from_json_text<Part>(text, place);
  if (!(part.least_light_chance >= 0 && part.least_light_chance <= 1))
    throw Error("{}: its chance to ask a light is {}", place, part.least_light_chance);
  if (part.shard && (part.shard->count < 1 || part.shard->count > most_shards ||
                     part.shard->index > part.shard->count)) {
    throw Error("{}: it is shard {}", place, part.shard->text());
  }
  return part;
}

std::string told(const Part& part) {
  if (part.shard && part.shard->index > 0) return "shard " + part.shard->text();
  return fmt::format("{} merged parts", part.parts);
}

}  // namespace carlo
