/// @file fault_table.h
/// Collects what sweeps of injected faults have found, and prints it as one table after the last test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace fx::test {

/// Counts of one kind of fault. Each injected fault is one call that returned; a crash would end the test.
struct FaultRow
{
    std::string fault;
    uint64_t injected = 0;
    uint64_t refused = 0;  ///< number of calls that returned an error; the others succeeded without it
    int64_t glObjects = 0; ///< number of GL names that were left, after the view or context was destroyed
    int64_t blocks = 0;    ///< number of blocks of the host's allocator that were left
    uint64_t glStates = 0; ///< number of faults after which a GL state of the host had changed
    uint64_t scenes = 0;   ///< number of faults after which the hash of the simulation had changed
    uint64_t pictures = 0; ///< number of faults after which the picture was neither the frame nor the host's
    bool endsWithContext = false; ///< true: GL names, states and pictures end with the lost context
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
                known.glObjects += row.glObjects;
                known.blocks += row.blocks;
                known.glStates += row.glStates;
                known.scenes += row.scenes;
                known.pictures += row.pictures;
                return;
            }
        table_->rows_.push_back(row);
    }
    void TearDown() override
    {
        if (rows_.empty())
            return;
        const auto number = [](uint64_t value) { return std::to_string(value); };
        std::printf("| %-36s | %8s | %7s | %7s | %8s | %6s | %8s | %6s | %8s |\n", "fault", "injected",
                    "crashes", "refused", "GL names", "blocks", "GL state", "scenes", "pictures");
        for (const FaultRow& row : rows_)
            std::printf("| %-36s | %8s | %7s | %7s | %8s | %6s | %8s | %6s | %8s |\n", row.fault.c_str(),
                        number(row.injected).c_str(), "0", number(row.refused).c_str(),
                        row.endsWithContext ? "-" : std::to_string(row.glObjects).c_str(),
                        std::to_string(row.blocks).c_str(),
                        row.endsWithContext ? "-" : number(row.glStates).c_str(), number(row.scenes).c_str(),
                        row.endsWithContext ? "-" : number(row.pictures).c_str());
    }

private:
    static FaultTable* const table_; ///< owned by GoogleTest
    std::vector<FaultRow> rows_;
};

inline FaultTable* const FaultTable::table_ =
    static_cast<FaultTable*>(::testing::AddGlobalTestEnvironment(new FaultTable));

} // namespace fx::test
