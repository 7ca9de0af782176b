#include "cli/arguments.h"

#include "cli/error.h"

namespace carlo {

std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    std::string program = app.get_name();
    for (const CLI::App* verb : app.get_subcommands())
      program += " " + verb->get_name();
    throw Error("{} (see {} --help)", error.what(), program);
  }
  return std::nullopt;
}

}  // namespace carlo
