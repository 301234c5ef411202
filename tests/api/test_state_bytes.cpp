// What fxScene_RestoreState does with bytes that are not, or no longer, a state of this library.
#include "foundation/random/philox.h"
#include "fxsdk/scene/state_envelope.h"
#include "tests/api/api_fixture.h"

#include <cstring>

using fx::test::loadText;
using fx::test::smallBlastPreset;

namespace {

class StateBytesApi : public fx::test::ApiTest
{
protected:
    StateBytesApi()
    {
        FxInstanceDef def = instanceDef();
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        def.preset = loadText(context_, smallBlastPreset());
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        def.position[0] = 3.0;
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK); // shares with the one before
        def.startTick = FX_TICKS_PER_SECOND;
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        FxInstanceId gone{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &gone), FX_OK);
        EXPECT_EQ(fxScene_DestroyInstance(scene_, gone), FX_OK);
        play(25);
        state_ = savedState();
        play(10);
        before_ = savedState();
    }

    /// The scene is as it was before an attempt to restore.
    bool isUnchanged() const { return savedState() == before_; }

    std::vector<std::byte> state_;
    std::vector<std::byte> before_;
};

uint32_t draw(uint64_t trial, uint32_t which, uint32_t below)
{
    return fx::base::philox({uint32_t(trial), uint32_t(trial >> 32), which, 0}, 11)[0] % below;
}

/// The same state with the header that belongs to it.
void seal(std::vector<std::byte>& state)
{
    const std::span<const std::byte> inside =
        std::span<const std::byte>(state).subspan(fx::scene::kStateHeaderBytes);
    fx::scene::writeStateHeader(inside, FX_VERSION, state.data());
}

} // namespace

TEST_F(StateBytesApi, everyCutIsRefused)
{
    for (size_t size = 0; size < state_.size(); ++size)
        ASSERT_EQ(fxScene_RestoreState(scene_, state_.data(), size), FX_ERROR_PARSE) << size;
    EXPECT_TRUE(isUnchanged());
    state_.push_back(std::byte{0});
    EXPECT_EQ(restore(state_), FX_ERROR_PARSE);
    EXPECT_TRUE(isUnchanged());
}

TEST_F(StateBytesApi, everyDamagedByteIsRefused)
{
    for (size_t at = 0; at < state_.size(); ++at) {
        std::vector<std::byte> damaged = state_;
        damaged[at] ^= std::byte(1u << draw(at, 0, 8));
        const FxResult result = restore(damaged);
        const bool isVersion = at >= 4 && at < 12;
        ASSERT_EQ(result, isVersion ? FX_ERROR_VERSION : FX_ERROR_PARSE) << at;
    }
    EXPECT_TRUE(isUnchanged());
}

TEST_F(StateBytesApi, severalDamagedBytesAreRefused)
{
    for (uint64_t trial = 0; trial < 2000; ++trial) {
        std::vector<std::byte> damaged = state_;
        const uint32_t flips = 2 + draw(trial, 1, 30);
        for (uint32_t k = 0; k < flips; ++k)
            damaged[draw(trial, 2 + 2 * k, uint32_t(damaged.size()))] ^=
                std::byte(1 + draw(trial, 3 + 2 * k, 255));
        ASSERT_TRUE(damaged == state_ || restore(damaged) != FX_OK) << trial;
    }
    EXPECT_TRUE(isUnchanged());
}

TEST_F(StateBytesApi, aStateOfAnotherVersionIsRefusedByName)
{
    const std::span<const std::byte> inside =
        std::span<const std::byte>(state_).subspan(fx::scene::kStateHeaderBytes);
    fx::scene::writeStateHeader(inside, 65536 * 7 + 256 * 8 + 9, state_.data());
    EXPECT_EQ(restore(state_), FX_ERROR_VERSION);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "7.8.9"), nullptr) << fxGetLastErrorMessage();
    EXPECT_TRUE(isUnchanged());
}

TEST_F(StateBytesApi, otherFilesAreNotStates)
{
    const std::string preset = smallBlastPreset();
    EXPECT_EQ(fxScene_RestoreState(scene_, preset.data(), preset.size()), FX_ERROR_PARSE);
    const std::vector<std::byte> zeros(1000);
    EXPECT_EQ(restore(zeros), FX_ERROR_PARSE);
}

TEST_F(StateBytesApi, aForgedStateWithTheRightChecksumIsRefusedOrHarmless)
{
    uint32_t refused = 0, taken = 0;
    for (uint64_t trial = 0; trial < 3000; ++trial) {
        std::vector<std::byte> forged = state_;
        const uint32_t header = uint32_t(fx::scene::kStateHeaderBytes);
        // half of the forgeries hit the tables at the beginning, where sizes and identities are
        const uint32_t inside = trial % 2 ? uint32_t(forged.size()) - header : 700;
        forged[header + draw(trial, 5, inside)] = std::byte(draw(trial, 6, 256));
        if (trial % 3 == 0)
            forged.resize(header + draw(trial, 7, uint32_t(forged.size()) - header));
        seal(forged);
        if (restore(forged) == FX_OK) {
            ++taken;
            ASSERT_EQ(fxScene_Update(scene_, 2 * fx::test::kFrame), FX_OK) << trial;
            ASSERT_EQ(restore(before_), FX_OK) << trial << fxGetLastErrorMessage();
        } else {
            ++refused;
        }
        ASSERT_TRUE(trial % 100 != 0 || isUnchanged()) << trial;
    }
    EXPECT_TRUE(isUnchanged());
    EXPECT_GT(refused, 1000u);
    EXPECT_GT(taken, 100u);
}

TEST_F(StateBytesApi, theStateHoldsNoAddressesAndNoPadding)
{
    // two contexts, two scenes, the same calls: any pointer or uninitialized byte would show
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = 1;
    std::vector<std::vector<std::byte>> states;
    std::vector<FxContext*> contexts;
    for (int i = 0; i < 2; ++i) {
        FxContext* context = nullptr;
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context, smallBlastPreset());
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
        for (int frame = 0; frame < 20; ++frame)
            ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        size_t size = 0;
        ASSERT_EQ(fxScene_SaveState(scene, nullptr, 0, &size), FX_OK);
        states.emplace_back(size, std::byte(i)); // so that a byte which is not written differs
        ASSERT_EQ(fxScene_SaveState(scene, states.back().data(), size, &size), FX_OK);
        contexts.push_back(context);
    }
    EXPECT_EQ(states[0], states[1]);
    for (FxContext* context : contexts)
        EXPECT_EQ(fxDestroyContext(context), FX_OK);
}
