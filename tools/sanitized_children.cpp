// Linked into tests that start programs. Under the sanitizers this process has read its own options by now, its children will find these.

#include <cstdlib>

namespace {

[[maybe_unused]] const int set = setenv("ASAN_OPTIONS", "detect_leaks=0", 0);

}  // namespace
