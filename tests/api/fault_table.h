/// @file fault_table.h
/// Collects what sweeps of injected faults have found, and prints it as one table after the last test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace fx::test {

/// Counts of one kind of fault. Each injected fault is one call that returned; a crash ends the tests before
/// the table is printed. A count without a value was not measured.
struct FaultRow
{
    std::string fault;
    uint64_t injected = 0;
    uint64_t refused = 0; ///< number of calls that returned an error; the others succeeded without it
    /// number of GL names that were left, after views and context were destroyed
    std::optional<int64_t> glObjects{};
    /// number of blocks of the host's allocator that were left, after the context was destroyed
    std::optional<int64_t> blocks{};
    std::optional<int64_t> glStates{}; ///< number of faults after which a GL state of the host had changed
    std::optional<int64_t> scenes{}; ///< number of faults after which the hash of the simulation had changed
    /// number of faults after which the picture, or that of the next frame, was wrong
    std::optional<int64_t> pictures{};

    /// Adds to a count, which is measured from then on.
    static void add(std::optional<int64_t>& ioCount, int64_t more) { ioCount = ioCount.value_or(0) + more; }
};

class FaultTable : public ::testing::Environment
{
public:
    static void note(const FaultRow& row)
    {
        for (FaultRow& known : table_->rows_)
            if (known.fault == row.fault) {
                known.injected += row.injected;
                known.refused += row.refused;
                for (const auto count : {&FaultRow::glObjects, &FaultRow::blocks, &FaultRow::glStates,
                                         &FaultRow::scenes, &FaultRow::pictures})
                    if (row.*count)
                        FaultRow::add(known.*count, *(row.*count));
                return;
            }
        table_->rows_.push_back(row);
    }
    void TearDown() override
    {
        if (rows_.empty())
            return;
        const auto shown = [](const std::optional<int64_t>& count) {
            return count ? std::to_string(*count) : std::string("-");
        };
        std::printf("| %-36s | %8s | %7s | %8s | %6s | %8s | %6s | %8s |\n", "fault", "injected", "refused",
                    "GL names", "blocks", "GL state", "scenes", "pictures");
        for (const FaultRow& row : rows_)
            std::printf("| %-36s | %8llu | %7llu | %8s | %6s | %8s | %6s | %8s |\n", row.fault.c_str(),
                        static_cast<unsigned long long>(row.injected),
                        static_cast<unsigned long long>(row.refused), shown(row.glObjects).c_str(),
                        shown(row.blocks).c_str(), shown(row.glStates).c_str(), shown(row.scenes).c_str(),
                        shown(row.pictures).c_str());
    }

private:
    static FaultTable* const table_; ///< owned by GoogleTest
    std::vector<FaultRow> rows_;
};

inline FaultTable* const FaultTable::table_ =
    static_cast<FaultTable*>(::testing::AddGlobalTestEnvironment(new FaultTable));

} // namespace fx::test
