/// A technique of its own is measured through the lists of measurements alone.
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/bench/bench_row.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

TEST(MarkerMeasurements, theBenchRowIsASubcommandBesideThoseOfTheProduct)
{
    const auto& all = benchMeasurements();
    const auto marker = std::ranges::find(all, "marker", &BenchMeasurement::name);
    ASSERT_NE(marker, all.end());
    EXPECT_NE(std::ranges::find(all, "sort", &BenchMeasurement::name), all.end());
    CLI::App command;
    int exitCode = -1;
    marker->addOptions(command, exitCode);
    const char* const arguments[] = {"marker", "--count", "10", "--steps", "3", "--json"};
    testing::internal::CaptureStdout();
    command.parse(int(std::size(arguments)), arguments);
    const auto line = nlohmann::json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(exitCode, 0);
    EXPECT_EQ(line["steps"], 30);
}

TEST(MarkerMeasurements, theAccuracyEntryIsBesideThoseOfTheProduct)
{
    const auto& all = accuracyTechniques();
    const auto marker = std::ranges::find(all, "marker", &AccuracyTechniqueEntry::name);
    ASSERT_NE(marker, all.end());
    EXPECT_GT(all.size(), 3u);
    const auto sample = marker->make("rise", {})->run(0, [] { return false; });
    ASSERT_TRUE(sample.ok());
    EXPECT_GT(sample->errorMax, 0.0);
    EXPECT_LT(sample->errorMax, 2e-7); // two roundings to float
}

} // namespace
} // namespace fx::cli
