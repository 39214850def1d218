// SPDX-License-Identifier: LGPL-2.1-or-later

// kinds.py as a process, on reports of mtstereo-eval.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support.hpp"

namespace mtstereo::eval::kinds_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;

class Kinds : public ::testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments) const {
    return testing::run_program(getenv("MTSTEREO_KINDS"), arguments);
  }
  std::string file(const std::string& name, const json& report) const {
    testing::write_file(folder_ / name, report.dump());
    return folder_ / name;
  }
  testing::TemporaryFolder folder_;
};

json means(double avgerr) {
  return {{"mtstereo", {{"density", 64.04}, {"all", {{"avgerr", avgerr}, {"d_all", nullptr}}}}}};
}

json report_of(const char* preset, double avgerr) {
  return {{"parameters", {{"preset", preset}, {"mode", "dense"}}},
          {"mean", means(avgerr)},
          {"degraded", {{{"kind", "noise=5"}, {"mean", means(2 * avgerr)}}}}};
}

json curve_of(double own, const json& other) {
  const auto line = [](const char* name, const json& error) {
    const json point{{"density", 30}, {"avgerr", error}, {"d_all", 7}, {"bad1", 1}};
    const std::vector<json> densities{{{"d_all", 0.5}, {"density", error}},
                                      {{"d_all", 1}, {"density", 44.04}}};
    return json{{"name", name}, {"at_density", std::vector<json>{point}}, {"at_d_all", densities}};
  };
  return {{"curves", std::vector<json>{line("mtstereo", own), line("bm", other)}}};
}

TEST_F(Kinds, PutsTheModesBesideEachOther) {
  const Outcome done = run({"modes", file("a.json", report_of("default", 0.25)),
                            file("b.json", report_of("fast", 0.5))});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("| images | dense | fast, dense |\n"));
  EXPECT_THAT(done.out, HasSubstr("| clean | 0.25 / - / 64.0 | 0.50 / - / 64.0 |\n"));
  EXPECT_THAT(done.out, HasSubstr("| noise=5 | 0.50 / - / 64.0 | 1.00 / - / 64.0 |\n"));
}

TEST_F(Kinds, ComparesTwoMethodsAtEqualDensity) {
  json report = report_of("default", 0.25);
  report["curve"] = curve_of(0.1, 0.2);
  report["degraded"][0]["curve"] = curve_of(0.3, nullptr);
  const std::string name = file("a.json", report);
  const Outcome done = run({"equal", name});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("avgerr, mtstereo / bm"));
  EXPECT_THAT(done.out, HasSubstr("| clean | 0.100 / 0.200 |\n| noise=5 | 0.300 / - |\n"));
  EXPECT_THAT(run({"equal", name, "--measure", "d_all"}).out, HasSubstr("| 7.00 / 7.00 |"));
  const Outcome unknown = run({"equal", name, "--rival", "elas"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("its curves are mtstereo, bm"));
}

TEST_F(Kinds, ComparesTwoMethodsAtEqualDAll) {
  json report = report_of("default", 0.25);
  report["curve"] = curve_of(20, 10);
  report["degraded"][0]["curve"] = curve_of(15, nullptr);
  const std::string name = file("a.json", report);
  const Outcome done = run({"density", name});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out,
              HasSubstr("density, mtstereo / bm, at equal d_all %\n\n| images | 0.5 | 1 |"));
  EXPECT_THAT(done.out, HasSubstr("| clean | 20.0 / 10.0 | 44.0 / 44.0 |\n"
                                  "| noise=5 | 15.0 / - | 44.0 / 44.0 |\n"));
  EXPECT_THAT(run({"density", name, "--rival", "mtstereo"}).out, HasSubstr("20.0 / 20.0"));
  EXPECT_THAT(run({"density", name, "--rival", "elas"}).err, HasSubstr("its curves are"));
  EXPECT_EQ(run({"density", name, "--measure", "d_all"}).status, 2);
  EXPECT_THAT(run({"density", file("b.json", report_of("fast", 1))}).err,
              HasSubstr("has no curve: run mtstereo-eval with --curve"));
}

TEST_F(Kinds, NamesFilesThatAreNoReports) {
  EXPECT_THAT(run({"modes", folder_ / "none.json"}).err, HasSubstr("none.json: cannot be read"));
  EXPECT_THAT(run({"modes", file("a.json", 7)}).err, HasSubstr("a.json: is not a report"));
  EXPECT_THAT(run({"equal", file("a.json", report_of("fast", 1))}).err,
              HasSubstr("has no curve: run mtstereo-eval with --curve"));
  const Outcome broken = run({"modes", file("a.json", {{"mean", 3}})});
  EXPECT_EQ(broken.status, 2);
  EXPECT_THAT(broken.err, Not(HasSubstr("Traceback")));
  EXPECT_EQ(run({"beauty"}).status, 2);
}

}  // namespace
}  // namespace mtstereo::eval::kinds_test
