// A viewer that misbehaves on command: what the conformance tests hold the protocol's client to.
// Usage: sheen-cts-fake-viewer PLAN.json with
//   {"log": FILE,              appends a line each time it starts
//    "requests": FILE,         appends each request, a line each
//    "hello": {...},           the first line; or a string, printed as it is; or null for silence
//    "answers": {SUBSTRING: HOW}}   by a piece of the request's scene, or of the file of a function's arguments; "*" for all others
// HOW: {"image": FILE}, copied to the request's output; or one of "crash", "exit", "hang", "garbage", "close", "wrong_id", "unsupported",
// "failed", "no_file", "wrong_status", "endless".
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

using nlohmann::json;

json choose(const json& answers, const std::string& asked) {
  for (const auto& [piece, how] : answers.items()) {
    if (piece != "*" && asked.find(piece) != std::string::npos) {
      return how;
    }
  }
  return answers.value("*", json("failed"));
}

void misbehave(const std::string& how) {
  if (how == "crash") {
    std::signal(SIGSEGV, SIG_DFL);
    std::cerr << "about to crash" << std::endl;
    std::raise(SIGSEGV);
  }
  if (how == "exit") {
    std::exit(3);
  }
  if (how == "hang") {
    while (true) {
      pause();
    }
  }
  if (how == "close") {
    std::cout.flush();
    close(STDOUT_FILENO);
    while (true) {
      pause();
    }
  }
  if (how == "endless") {
    const std::string chunk(65536, 'x');
    while (std::cout << chunk) {
    }
  }
}

void answer(const json& request, const json& how) {
  json reply = {{"id", request.at("id")}, {"status", "rendered"}, {"image", request.at("output")}, {"seconds", 0.25}, {"message", ""}};
  const std::string output = request.at("output").get<std::string>();
  if (how.is_object()) {
    std::filesystem::copy_file(how.at("image").get<std::string>(), output, std::filesystem::copy_options::overwrite_existing);
  } else {
    const std::string word = how.get<std::string>();
    misbehave(word);
    if (word == "garbage") {
      std::cout << "Segmentation fault (or so it seems)" << std::endl;
      return;
    }
    if (word == "wrong_id") {
      reply["id"] = "another";
    }
    if (word == "unsupported" || word == "failed") {
      reply["status"] = word;
      reply["message"] = "told to";
    }
    if (word == "wrong_status") {
      reply["status"] = "perhaps";
    }
  }
  std::cout << reply.dump() << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  std::ifstream file(argv[1]);
  const json plan = json::parse(file);
  if (plan.contains("log")) {
    std::ofstream(plan["log"].get<std::string>(), std::ios::app) << "started\n";
  }
  const json hello = plan.value("hello", json(nullptr));
  if (hello.is_null()) {
    while (true) {
      pause();
    }
  }
  std::cout << (hello.is_string() ? hello.get<std::string>() : hello.dump()) << std::endl;
  std::string line;
  while (std::getline(std::cin, line)) {
    const json request = json::parse(line);
    if (plan.contains("requests")) {
      std::ofstream(plan["requests"].get<std::string>(), std::ios::app) << line << "\n";
    }
    const std::string asked = request.at(request.contains("function") ? "arguments" : "scene").get<std::string>();
    answer(request, choose(plan.value("answers", json::object()), asked));
  }
  return 0;
}
