// Every preset of the library plays, is looked at, moved, saved and brought back. The checks are those of the
// build: indices where the standard library asserts them (_GLIBCXX_ASSERTIONS, as in Debug builds), memory
// and arithmetic under sanitizers.
#include "tests/api/api_fixture.h"
#include "tests/api/library_names.h"

#include <string>
#include <vector>

using fx::test::kFrame;

namespace {

class LibraryPlay : public fx::test::ApiTest
{
protected:
    /// Reads every number that a host can see of the last step. @return elements
    uint64_t look() const
    {
        FxSnapshotId snapshot{};
        EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK) << fxGetLastErrorMessage();
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetSnapshotInfo(scene_, snapshot, &info), FX_OK);
        uint64_t elements = 0;
        for (uint32_t g = 0; g < info.groupsNewer; ++g) {
            FxSnapshotGroup group{};
            group.structSize = sizeof group;
            EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot, FX_SNAPSHOT_NEWER, g, &group), FX_OK);
            elements += group.count;
            for (uint32_t c = 0; c < group.columnCount; ++c) {
                FxSnapshotColumn column{};
                column.structSize = sizeof column;
                EXPECT_EQ(fxScene_GetSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, g, c, &column),
                          FX_OK);
            }
        }
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
        return elements;
    }
};

} // namespace

TEST_F(LibraryPlay, everyPresetPlaysMovesAndComesBackFromASavedState)
{
    const float rotation[4] = {0, 0, 0, 1};
    for (const std::string& name : fx::test::libraryNames()) {
        SCOPED_TRACE(name);
        FxInstanceDef def = fxDefaultInstanceDef();
        ASSERT_EQ(fxLoadPresetLibrary(context_, name.c_str(), &def.preset), FX_OK) << fxGetLastErrorMessage();
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        uint64_t most = 0;
        for (int frame = 0; frame < 75; ++frame) {
            const double position[3] = {0.02 * frame, 0.0, 0.01 * frame};
            if (frame > 30) {
                ASSERT_EQ(fxScene_SetTransform(scene_, id, position, rotation, 1.0f), FX_OK);
            }
            play(1);
            most = std::max(most, look());
        }
        EXPECT_GT(most, 0u);
        const uint64_t before = simulationHash();
        const std::vector<std::byte> state = savedState();
        play(2);
        ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(simulationHash(), before);
        ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    }
}
