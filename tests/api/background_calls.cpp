#include "tests/api/background_calls.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstring>
#include <utility>

namespace fx::test {

namespace {

constexpr std::chrono::milliseconds kPause{1}; ///< between calls: what is tested is what others do meanwhile

/// Every number of one group.
uint64_t digestOf(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step, uint32_t index)
{
    FxSnapshotGroup group{};
    group.structSize = sizeof group;
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, step, index, &group), FX_OK)
        << fxGetLastErrorMessage();
    uint64_t digest = group.count;
    const auto add = [&digest](uint64_t word) { digest = std::rotl(digest, 7) ^ word; };
    for (uint32_t i = 0; group.ids && i < group.count; ++i)
        add(group.ids[i]);
    for (uint32_t i = 0; i < group.constantCount; ++i)
        add(std::bit_cast<uint32_t>(group.constants[i]));
    for (uint32_t c = 0; c < group.columnCount; ++c) {
        FxSnapshotColumn column{};
        column.structSize = sizeof column;
        EXPECT_EQ(fxScene_GetSnapshotColumn(scene, snapshot, step, index, c, &column), FX_OK);
        for (uint32_t i = 0; i < column.count; ++i)
            add(column.values ? std::bit_cast<uint32_t>(column.values[i]) : column.values64[i]);
    }
    return digest;
}

uint64_t digestOf(FxScene* scene, FxSnapshotId snapshot)
{
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK) << fxGetLastErrorMessage();
    uint64_t digest = uint64_t(info.tickNewer);
    for (uint32_t g = 0; g < info.groupsNewer; ++g)
        digest = std::rotl(digest, 3) ^ digestOf(scene, snapshot, FX_SNAPSHOT_NEWER, g);
    for (uint32_t g = 0; g < info.groupsOlder; ++g)
        digest = std::rotl(digest, 3) ^ digestOf(scene, snapshot, FX_SNAPSHOT_OLDER, g);
    return digest;
}

void checkBrokenPreset(FxContext* context)
{
    FxPresetId preset{};
    EXPECT_EQ(fxLoadPresetText(context, "{", 1, "broken preset", &preset), FX_ERROR_PARSE);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "broken preset"), nullptr) << fxGetLastErrorMessage();
}

} // namespace

/// Calls once at least, so that no count depends on who is scheduled first.
template <class F>
void BackgroundCalls::repeat(std::atomic<uint64_t>& count, F&& call)
{
    threads_.emplace_back([this, &count, call = std::forward<F>(call)]() mutable {
        do {
            call();
            ++count;
            std::this_thread::sleep_for(kPause);
        } while (!isOver_);
    });
}

void BackgroundCalls::readSnapshots(FxScene* scene)
{
    repeat(snapshots_, [scene] {
        FxSnapshotId first{}, second{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &first), FX_OK) << fxGetLastErrorMessage();
        const uint64_t digest = digestOf(scene, first);
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &second), FX_OK) << fxGetLastErrorMessage();
        (void)digestOf(scene, second);
        EXPECT_EQ(digestOf(scene, first), digest) << "a snapshot has changed while it was held";
        ASSERT_EQ(fxScene_ReleaseSnapshot(scene, first), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_ReleaseSnapshot(scene, second), FX_OK) << fxGetLastErrorMessage();
    });
}

void BackgroundCalls::loadPresets(FxContext* context)
{
    repeat(loads_, [context, next = 0u]() mutable {
        constexpr const char* kNames[] = {"debris", "steam", "rain", "tracer", "sparks"};
        FxPresetId preset{};
        ASSERT_EQ(fxLoadPresetLibrary(context, kNames[next++ % std::size(kNames)], &preset), FX_OK)
            << fxGetLastErrorMessage();
        FxPresetInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxGetPresetInfo(context, preset, &info), FX_OK) << fxGetLastErrorMessage();
        EXPECT_GT(info.solverCount, 0u);
        FxPresetPreview preview{};
        preview.structSize = sizeof preview;
        EXPECT_EQ(fxGetPresetPreview(context, preset, &preview), FX_OK) << fxGetLastErrorMessage();
        checkBrokenPreset(context);
        EXPECT_EQ(fxUnloadPreset(context, preset), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxUnloadPreset(context, preset), FX_ERROR_STALE_ID);
    });
}

void BackgroundCalls::readMemoryStatistics(FxContext* context)
{
    repeat(memoryReadings_, [context, allocations = uint64_t(0)]() mutable {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        ASSERT_EQ(fxContext_GetMemoryStats(context, &stats), FX_OK) << fxGetLastErrorMessage();
        EXPECT_GE(stats.allocationCount, std::exchange(allocations, stats.allocationCount));
        EXPECT_GT(stats.bytesInUse, 0u);
        EXPECT_GE(stats.scenes, 1u);
    });
}

void BackgroundCalls::stop()
{
    isOver_ = true;
    for (std::thread& thread : threads_)
        thread.join();
    threads_.clear();
}

} // namespace fx::test
