#include "tools/parser.h"

int main(int argc, char** argv) {
  return sheen::tools::run_command_line(argc, argv);
}
