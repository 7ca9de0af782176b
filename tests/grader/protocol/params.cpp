#include "grader/protocol/params.h"

#include "cli/error.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace carlo::grader {

using nlohmann::json;

double Params::operator[](const std::string& name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end()) throw Error("the probe needs the number \"{}\"", name);
  return found->second;
}

std::int64_t Params::whole(const std::string& name) const {
  const double value = (*this)[name];
  if (!(std::abs(value) < 0x1p53) || value != std::floor(value)) {
    throw Error("the probe needs a whole number \"{}\", got {}", name, value);
  }
  return static_cast<std::int64_t>(value);
}

std::string to_json(const Params& params) {
  return json{{"seed", params.seed}, {"n", params.n}, {"numbers", params.numbers}}.dump();
}

Params params_from_json(const std::string& text) {
  try {
    const json document = json::parse(text);
    Params params;
    params.seed = document.at("seed").get<std::uint64_t>();
    params.n = document.at("n").get<std::int64_t>();
    params.numbers = document.at("numbers").get<std::map<std::string, double>>();
    return params;
  } catch (const json::exception& error) {
    throw Error("bad parameters {}: {}", text, error.what());
  }
}

}  // namespace carlo::grader
