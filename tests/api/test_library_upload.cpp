// What a frame of each preset of the library sends over the bus and draws, at as many frames as steps and at
// half as many.
#include "tests/api/library_names.h"
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace {

constexpr uint64_t kBlobBytes = 96;    ///< of a particle of a medium
constexpr uint64_t kMaxRowBytes = 32;  ///< of a sprite or a point of a ribbon, with its place in an order
constexpr uint64_t kMaxMeshBytes = 44; ///< of a mesh that turns and flies
constexpr uint32_t kMaxBatches = 16;
constexpr uint32_t kOthers = 8; ///< draws of what hides, and of passes that draw more than once

class LibraryUpload : public fx::test::ViewApiTest
{
protected:
    void play(const std::string& preset)
    {
        FxSceneDef sceneDef = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &sceneDef, &played_), FX_OK);
        FxInstanceDef def = fxDefaultInstanceDef();
        ASSERT_EQ(fxLoadPresetLibrary(context_, preset.c_str(), &def.preset), FX_OK) << preset;
        def.seed = 5;
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(played_, &def, &id), FX_OK);
        ASSERT_EQ(fxCreateView(context_, played_, nullptr, &shown_), FX_OK);
    }
    void end()
    {
        EXPECT_EQ(fxDestroyView(shown_), FX_OK);
        EXPECT_EQ(fxDestroyScene(played_), FX_OK);
    }

    /// What the rows of the newest step may cost; each group begins at a multiple of 64 bytes.
    uint64_t mostBytes()
    {
        FxSnapshotId snapshot{};
        EXPECT_EQ(fxScene_AcquireSnapshot(played_, &snapshot), FX_OK);
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetSnapshotInfo(played_, snapshot, &info), FX_OK);
        uint64_t bytes = 0;
        for (uint32_t g = 0; g < info.groupsNewer; ++g) {
            FxSnapshotGroup group{};
            group.structSize = sizeof group;
            EXPECT_EQ(fxScene_GetSnapshotGroup(played_, snapshot, FX_SNAPSHOT_NEWER, g, &group), FX_OK);
            const std::string_view kind = group.kind;
            bytes += 64;
            if (kind == "particle")
                bytes += group.count * (group.constants[0] == 1.0f ? kMaxMeshBytes : kMaxRowBytes);
            else if (kind == "ribbon")
                bytes += group.count * kMaxRowBytes;
        }
        EXPECT_EQ(fxScene_ReleaseSnapshot(played_, snapshot), FX_OK);
        return bytes;
    }

    FxViewStatistics show()
    {
        FxFrameDef def = frame();
        def.origin[1] = 4.0;
        def.origin[2] = 25.0;
        EXPECT_EQ(fxView_Render(shown_, &def), FX_OK) << fxGetLastErrorMessage();
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxView_GetStatistics(shown_, &statistics), FX_OK);
        return statistics;
    }

    FxScene* played_ = nullptr;
    FxView* shown_ = nullptr;
};

} // namespace

TEST_F(LibraryUpload, isAtMostThirtyTwoBytesARowAndFewTurns)
{
    uint64_t most = 0;
    for (const std::string& name : fx::test::libraryNames()) {
        for (const double rate : {60.0, 30.0}) {
            play(name);
            for (int step = 0; step < 20; ++step)
                ASSERT_EQ(fxScene_Update(played_, 0.05), FX_OK);
            for (int i = 0; i < 4; ++i) {
                ASSERT_EQ(fxScene_Update(played_, 1.0 / rate), FX_OK);
                const FxViewStatistics s = show();
                const uint64_t media = kBlobBytes * (s.blobs + s.impostors);
                if (s.impostorsTaken == 0) {
                    EXPECT_LE(s.uploadedBytes, mostBytes() + media)
                        << name << " at " << rate << " frame " << i;
                }
                EXPECT_LE(s.drawCalls, s.passes + kMaxBatches + kOthers) << name << " at " << rate;
                most = std::max(most, s.uploadedBytes - std::min(s.uploadedBytes, media));
            }
            end();
        }
    }
    EXPECT_GT(most, 100'000u) << "the control: some are large";
}
