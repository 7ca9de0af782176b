#include "grader/worker/probe.h"

#include "support/error.h"

#include <utility>

namespace carlo::grader {

std::map<std::string, NamedProbe>& probes() {
  static std::map<std::string, NamedProbe> registry;
  return registry;
}

Registration::Registration(Probe probe, std::initializer_list<const char*> words) {
  const std::string name = *words.begin();
  NamedProbe named{probe, {words.begin() + 1, words.end()}, ""};
  if (!named.names.empty() && named.names.back().front() == '(') {
    named.remark = named.names.back();
    named.names.pop_back();
  }
  if (!probes().emplace(name, std::move(named)).second) {
    throw Error("two probes are named \"{}\"", name);
  }
}

void RowWriter::add(std::initializer_list<double> row) {
  if (rows_.columns == 0) rows_.columns = row.size();
  if (rows_.columns != row.size()) throw Error("a probe's rows differ in length");
  rows_.values.insert(rows_.values.end(), row);
}

}  // namespace carlo::grader
