#include "conformance/serve.h"

#include <iostream>
#include <sstream>

#include "tools/errors.h"
#include "tools/options.h"
#include "tools/words.h"

namespace sheen::tools {

int serve(const ServeOptions& options) {
  const conformance::ServeOptions settings{word_of(context_words, options.context), word_of(precision_words, options.precision)};
  if (options.json) {
    // One object: what the viewer says of itself. Nothing is asked of it, so it ends there.
    std::istringstream nothing;
    conformance::serve(nothing, std::cout, settings);
  } else {
    conformance::serve(std::cin, std::cout, settings);
  }
  return done;
}

}  // namespace sheen::tools
