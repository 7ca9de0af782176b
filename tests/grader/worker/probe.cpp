#include "grader/worker/probe.h"

#include "cli/error.h"

namespace carlo::grader {

std::map<std::string, Probe>& probes() {
  static std::map<std::string, Probe> registry;
  return registry;
}

Registration::Registration(const char* name, Probe probe) {
  if (!probes().emplace(name, probe).second) throw Error("two probes are named \"{}\"", name);
}

void RowWriter::add(std::initializer_list<double> row) {
  if (rows_.columns == 0) rows_.columns = row.size();
  if (rows_.columns != row.size()) throw Error("a probe's rows differ in length");
  rows_.values.insert(rows_.values.end(), row);
}

}  // namespace carlo::grader
