#include "conformance/run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/environments.h"
#include "conformance/glb.h"
#include "conformance/goldens.h"
#include "conformance/judge.h"
#include "conformance/judge_function.h"
#include "conformance/judge_relation.h"
#include "conformance/paths.h"
#include "conformance/replicas.h"
#include "conformance/report.h"
#include "conformance/results.h"
#include "conformance/suite.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;

/// Prepares cases on threads of its own, a few ahead of the one that is drawn: the viewer is a process apart, so that its drawing and our
/// goldens run side by side.
class Prefetcher {
 public:
  using Prepare = std::function<PreparedCase(std::size_t)>;

  explicit Prefetcher(Prepare prepare) : prepare_(std::move(prepare)) {}
  ~Prefetcher() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) {
      thread.join();
    }
  }
  Prefetcher(const Prefetcher&) = delete;
  Prefetcher& operator=(const Prefetcher&) = delete;

  /// Starts on these cases, in this order.
  void start(std::vector<std::size_t> order) {
    order_ = std::move(order);
    const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1U, 4U);
    for (unsigned i = 0; i < count; ++i) {
      threads_.emplace_back([this] { work(); });
    }
  }

  /// The case, prepared; prepares it here if no thread has it in hand.
  PreparedCase take(std::size_t index) {
    std::unique_lock lock(mutex_);
    const auto claimed = std::find(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(claimed_), index);
    const bool in_hand = claimed != order_.begin() + static_cast<std::ptrdiff_t>(claimed_) && !taken_[index];
    if (!in_hand) {
      lock.unlock();
      return prepare_(index);
    }
    changed_.wait(lock, [&] { return ready_.contains(index); });
    PreparedCase prepared = std::move(ready_.at(index));
    ready_.erase(index);
    taken_[index] = true;
    ++taken_count_;
    changed_.notify_all();
    return prepared;
  }

 private:
  /// Prepared cases hold a scene and a golden, a few megabytes each.
  static constexpr std::size_t most_ahead = 12;

  void work() {
    while (true) {
      std::size_t index = 0;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return stopped_ || claimed_ == order_.size() || claimed_ < taken_count_ + most_ahead; });
        if (stopped_ || claimed_ == order_.size()) {
          return;
        }
        index = order_[claimed_++];
      }
      PreparedCase prepared = prepare_(index);
      {
        const std::lock_guard lock(mutex_);
        ready_.emplace(index, std::move(prepared));
      }
      changed_.notify_all();
    }
  }

  Prepare prepare_;
  std::vector<std::size_t> order_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t claimed_ = 0;
  std::size_t taken_count_ = 0;
  std::map<std::size_t, bool> taken_;
  std::map<std::size_t, PreparedCase> ready_;
  bool stopped_ = false;
};

/// One run: what the tests share.
class Session {
 public:
  Session(const RunOptions& options, Suite suite, std::vector<std::string> command)
      : options_(options),
        suite_(std::move(suite)),
        cache_(options.cache.empty() ? default_cache() : options.cache),
        images_(options.report / "images"),
        viewer_(std::move(command), {options.start_limit_seconds, options.case_limit_seconds}),
        hello_(viewer_.hello()),
        store_(cache_ / "goldens", options.goldens.empty() ? find_goldens() : options.goldens, suite_.name),
        prefetcher_([this](std::size_t i) { return prepare(suite_.cases[i]); }) {
    const auto settle_precision = [&](std::vector<Case>& cases) {
      for (Case& one : cases) {
        one.precision = one.precision.value_or(parse_golden_precision(options.precision));
      }
    };
    settle_precision(suite_.cases);
    for (Relation& relation : suite_.relations) {
      if (hello_.is_ours()) {
        settle_precision(relation.scenes);
      }
    }
  }

  const Suite& suite() const { return suite_; }
  const Hello& hello() const { return hello_; }
  void plan(std::vector<std::size_t> order) {
    total_ = order.size();
    // Relations and functions have no golden to prepare.
    std::erase_if(order, [this](std::size_t index) { return suite_.case_at(index) == nullptr; });
    prefetcher_.start(std::move(order));
  }
  std::size_t planned() const { return total_; }

  /// Runs the case, relation or function of that index.
  const CaseResult& run_case(std::size_t index) {
    CaseResult& result = results_[index];
    if (suite_.case_at(index) != nullptr) {
      result = hold_to_golden(index);
    } else if (const Relation* relation = suite_.relation_at(index)) {
      result = judge_relation(
          *relation, [this](const Case& scene) { return draw_scene(scene); }, hello_, images_);
    } else {
      result = judge_function(
          *suite_.function_at(index), [this](const FunctionRequest& request) { return viewer_.evaluate(request); }, hello_, images_);
    }
    if (options_.progress) {
      options_.progress({results_.size(), total_, suite_.name_of(index), to_string(result.status), result.message});
    }
    return result;
  }
  bool counts_as_passed(Status status) const { return status == Status::Pass || (status == Status::Approximation && !options_.strict); }

  std::vector<CaseResult> finish() {
    viewer_.finish();
    std::vector<CaseResult> all;
    for (auto& [index, result] : results_) {
      all.push_back(std::move(result));
    }
    return all;
  }

 private:
  Answer draw(const Case& one, const fs::path& scene_file) { return draw(one, scene_file, ".candidate", options_.environment_samples); }
  Answer draw(const Case& one, const fs::path& scene_file, const std::string& kind, int environment_samples) {
    const fs::path output = images_ / (one.name + kind + (hello_.encoding == Encoding::Srgb8 ? ".png" : ".exr"));
    const fs::path environment = one.environment.empty() ? fs::path() : environment_for_viewer(one.environment, hello_.is_ours(), cache_);
    const std::string precision = one.precision ? to_string(*one.precision) : "";
    const bool replicas = hello_.is_ours() && !one.environment.empty() && environment_samples > 0;
    return viewer_.draw({scene_file, 0, one.width, one.height, output, one.model, precision, environment,
                         replicas ? directions_of_replica(environment_samples) : environment_samples, replicas ? environment_replicas : 0});
  }
  PreparedCase prepare(const Case& one) const {
    const bool drawn = hello_.is_ours() && options_.environment_samples > 0;
    return prepare_case(one, store_, cache_ / "scenes", hello_.subpixel_bits,
                        drawn ? directions_of_replica(options_.environment_samples) : 0);
  }
  CaseResult hold_to_golden(std::size_t index) {
    const Case& one = suite_.cases[index];
    const PreparedCase prepared = prefetcher_.take(index);
    const Answer answer = prepared.problem.empty() ? draw(one, prepared.scene_file) : Answer{};
    CaseResult result = judge_case(one, prepared, answer, hello_, store_, images_);
    if (!one.environment.empty() && hello_.takes_settings() && options_.environment_samples > 0 &&
        answer.status == AnswerStatus::Rendered && prepared.problem.empty()) {
      result.message += (result.message.empty() ? "" : "; ") + realtime_error(one, prepared);
    }
    return result;
  }
  /// What a viewer that can do both loses where it filters the environment beforehand.
  std::string realtime_error(const Case& one, const PreparedCase& prepared) {
    const Answer answer = draw(one, prepared.scene_file, ".realtime", 0);
    if (answer.status != AnswerStatus::Rendered) {
      return "the real-time way was not drawn: " + answer.message;
    }
    try {
      const Verdict verdict = judge(image::read(answer.image), prepared.reference.image, {});
      return "the real-time way: 99 % of the values within " + percent(verdict.p99_rel) + ", the largest error " + percent(verdict.max_rel);
    } catch (const image::Error& error) {
      return std::string("the real-time way cannot be read: ") + error.what();
    }
  }
  Drawing draw_scene(const Case& scene) {
    if (!hello_.is_ours()) {
      const fs::path file = write_scene(scene, cache_ / "scenes");
      return {file, draw(scene, file), std::nullopt};
    }
    PreparedCase prepared = prepare(scene);
    if (!prepared.problem.empty()) {
      throw std::runtime_error("the golden of '" + scene.name + "': " + prepared.problem);
    }
    const Answer answer = draw(scene, prepared.scene_file);
    return {prepared.scene_file, answer, std::move(prepared)};
  }

  const RunOptions& options_;
  Suite suite_;
  fs::path cache_;
  fs::path images_;
  Viewer viewer_;
  Hello hello_;
  GoldenStore store_;
  std::map<std::size_t, CaseResult> results_;
  std::size_t total_ = 0;
  Prefetcher prefetcher_;
};

class CaseTest : public testing::Test {
 public:
  CaseTest(Session& session, std::size_t index) : session_(session), index_(index) {}

  void TestBody() override {
    const CaseResult& result = session_.run_case(index_);
    RecordProperty("verdict", to_string(result.status));  // "status" is GoogleTest's own
    if (result.verdict) {
      RecordProperty("bound_ratio", nlohmann::json(result.verdict->bound_ratio).dump());
      RecordProperty("max_rel", nlohmann::json(result.verdict->max_rel).dump());
    }
    if (!result.law.empty()) {
      RecordProperty("law", result.law);
    }
    if (!result.identified.empty()) {
      RecordProperty("identified", result.identified);
    }
    if (result.status == Status::Unsupported) {
      GTEST_SKIP() << result.message;
    }
    if (!session_.counts_as_passed(result.status)) {
      ADD_FAILURE() << to_string(result.status) << ": " << result.message;
    }
  }

 private:
  Session& session_;
  std::size_t index_;
};

/// Learns, once GoogleTest has applied filter and sharding, which cases will run.
class PlanListener : public testing::EmptyTestEventListener {
 public:
  PlanListener(Session& session, const std::map<std::string, std::size_t>& index_of) : session_(session), index_of_(index_of) {}

  void OnTestIterationStart(const testing::UnitTest& tests, int iteration) override {
    if (iteration > 0) {
      return;
    }
    std::vector<std::size_t> order;
    for (int s = 0; s < tests.total_test_suite_count(); ++s) {
      const testing::TestSuite& suite = *tests.GetTestSuite(s);
      if (suite.name() != session_.suite().name) {
        continue;
      }
      for (int t = 0; t < suite.total_test_count(); ++t) {
        const testing::TestInfo& info = *suite.GetTestInfo(t);
        if (info.should_run()) {
          order.push_back(index_of_.at(info.name()));
        }
      }
    }
    session_.plan(std::move(order));
  }

 private:
  Session& session_;
  const std::map<std::string, std::size_t>& index_of_;
};

std::vector<std::string> viewer_command(const RunOptions& options) {
  if (!options.viewer.empty() && options.viewer != "sheen-cts") {
    return split_command(options.viewer);
  }
  if (options.context != "osmesa" && options.context != "egl") {
    throw std::invalid_argument("unknown context '" + options.context + "'; known: osmesa, egl");
  }
  if (options.precision != "highp" && options.precision != "mediump") {
    throw std::invalid_argument("unknown precision '" + options.precision + "'; known: highp, mediump");
  }
  const fs::path program = options.executable.empty() ? this_program() : options.executable;
  return {program.string(), "serve", "--context", options.context, "--precision", options.precision};
}

/// Registers the cases that the filter lets through, and runs them under GoogleTest with nothing on standard output.
void run_tests(Session& session, const RunOptions& options, const std::vector<std::size_t>& chosen) {
  std::map<std::string, std::size_t> index_of;
  const std::string source = "conformance/suites/" + session.suite().name + ".json";
  for (const std::size_t index : chosen) {
    const std::string& name = session.suite().name_of(index);
    index_of[name] = index;
    testing::RegisterTest(session.suite().name.c_str(), name.c_str(), nullptr, nullptr, source.c_str(), 1,
                          [&session, index]() -> testing::Test* { return new CaseTest(session, index); });
  }
  std::vector<std::string> words = {"sheen-cts", "--gtest_output=xml:" + fs::absolute(options.report / "results.xml").string()};
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  int count = static_cast<int>(words.size());
  testing::InitGoogleTest(&count, arguments.data());
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  auto* plan = new PlanListener(session, index_of);
  listeners.Append(plan);
  // What it came to is in the session, case by case; its own yes or no adds nothing.
  [[maybe_unused]] const int failures = RUN_ALL_TESTS();
  delete listeners.Release(plan);
}

bool is_sharded() {
  const char* shards = std::getenv("GTEST_TOTAL_SHARDS");
  return shards != nullptr && std::atoi(shards) > 1;
}

}  // namespace

RunResult run(const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Suite suite = load_suite(options.suite);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < suite.size(); ++i) {
    if (matches_filter(options.filter, suite.name, suite.name_of(i))) {
      chosen.push_back(i);
    }
  }
  if (chosen.empty()) {
    throw std::invalid_argument("no case of suite " + suite.name + " matches the filter '" + options.filter + "'");
  }
  const std::vector<std::string> command = viewer_command(options);
  std::error_code error;
  fs::create_directories(options.report / "images", error);
  if (error) {
    throw image::Error(options.report.string() + ": the report's folder cannot be made: " + error.message());
  }

  RunRecord record;
  record.suite = suite.name;
  record.description = suite.description;
  record.strict = options.strict;
  for (const std::string& word : command) {
    record.viewer_command += (record.viewer_command.empty() ? "" : " ") + word;
  }
  Session session(options, std::move(suite), command);
  record.viewer = session.hello();
  run_tests(session, options, chosen);
  record.cases = session.finish();
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const RunResult result = summarize(record, is_sharded());
  try {
    write_file(options.report / "results.json", result.results_json);
    write_file(options.report / "index.html", report_html(record));
  } catch (const std::runtime_error& failure) {
    throw image::Error(failure.what());
  }
  return result;
}

}  // namespace sheen::conformance
