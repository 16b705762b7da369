// Our renderer as a viewer with one mistake: MUTANT names it, "none" is the control. It speaks the viewer protocol as `sheen-cts serve`
// does.
#include <cstdio>
#include <exception>
#include <iostream>

#include "conformance/mutants/mutant.h"
#include "conformance/serve.h"

int main(int argc, char** argv) {
  using namespace sheen;
  if (argc != 2) {
    std::fputs("usage: sheen-cts-mutant-viewer MUTANT\n", stderr);
    return 2;
  }
  try {
    const conformance::Mutant mutant = conformance::find_mutant(argv[1]);
    const std::map<std::string, std::string> files = conformance::shader_files(mutant);
    conformance::ServeOptions options;
    options.alter = [&](scene::Scene& scene, renderer::Settings& settings) {
      settings.shader_files = &files;
      if (mutant.alter) {
        mutant.alter(scene, settings);
      }
    };
    conformance::serve(std::cin, std::cout, options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
