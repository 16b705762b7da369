#include "conformance/joined_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sheen::conformance {
namespace {

using testing::HasSubstr;
using testing::Not;

CaseFigures figures_of(Status status, double bound_ratio, const std::string& message = "") {
  return {status, bound_ratio, 1e-4, bound_ratio / 1000, 75, 25, message};
}

JoinedRuns two_drivers() {
  JoinedRuns joined;
  joined.drivers.resize(2);
  joined.drivers[0].name = "first";
  joined.drivers[0].renderer = "llvmpipe (LLVM)";
  joined.drivers[0].subpixel_bits = 8;
  joined.drivers[1].name = "second";
  joined.drivers[1].renderer = "softpipe";
  joined.cases.push_back({"core", "lights.spot", {figures_of(Status::Pass, 0.125), figures_of(Status::Fail, 7.5, "the pixel at 3, 4")}});
  joined.cases.push_back({"core", "lights.point", {figures_of(Status::Pass, 0.25), std::nullopt}});
  return joined;
}

TEST(JoinedReport, ShowsEveryFigureOfEveryDriver) {
  const std::string html = joined_html(two_drivers());
  for (const char* text : {"llvmpipe (LLVM)", "softpipe", "0.125", "7.5", "p99 0.0001, excluded 25 %", "median bound 0.000125",
                           "median bound 0.0075", "second: the pixel at 3, 4", "1 fail, 1 missing", "2 pass", "not said"}) {
    EXPECT_THAT(html, HasSubstr(text));
  }
}

TEST(JoinedReport, NoBoundIsShownWhereNoneWasHeld) {
  JoinedRuns joined = two_drivers();
  for (CaseRow& row : joined.cases) {
    row.cells[0]->median_bound = std::nullopt;
  }
  joined.cases[0].cells[1]->median_bound = 0;
  EXPECT_THAT(joined_html(joined), Not(HasSubstr("median bound")));
}

TEST(JoinedReport, ARowCanBeFoundByEveryStatusInIt) {
  const std::string html = joined_html(two_drivers());
  EXPECT_THAT(html, HasSubstr("data-name=\"core.lights.spot\" data-status=\"fail pass\""));
  EXPECT_THAT(html, HasSubstr("data-name=\"core.lights.point\" data-status=\"pass missing\""));
  EXPECT_THAT(html, HasSubstr("<button data-status=missing"));
  EXPECT_THAT(html, Not(HasSubstr("<button data-status=crash")));
}

TEST(JoinedReport, HoldsItselfAndEscapesWhatItWasGiven) {
  JoinedRuns joined = two_drivers();
  const std::string hostile = "\"><script>alert('1')</script>";
  joined.drivers[0].name = joined.drivers[0].renderer = joined.drivers[0].version = hostile;
  joined.drivers[0].folders = {hostile};
  joined.cases[0].suite = joined.cases[0].name = hostile;
  joined.cases[0].cells[1]->message = hostile;
  const std::string html = joined_html(joined);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("\"><script")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(&#39;1&#39;)"));
  for (const char* outside : {"http:", "https:", "href=", "src=", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
}

}  // namespace
}  // namespace sheen::conformance
