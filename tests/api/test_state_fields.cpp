// Whatever a field of a saved state says, restoring it takes no more memory than the bytes can hold and the
// scene may: sizes are believed only as far as there is something behind them.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/scene/state_envelope.h"
#include "tests/api/api_fixture.h"
#include "tests/api/measured_new.h"

#include <cstring>
#include <limits>
#include <span>

using fx::test::kFrame;

namespace {

constexpr size_t kHeader = fx::scene::kStateHeaderBytes;

/// Where in a state numbers are that could be sizes.
class FieldFinder final : public fx::sim::StateWriter
{
public:
    struct Field
    {
        size_t offset; ///< [byte] behind the header
        size_t size;   ///< [byte] 4 or 8
    };
    const std::vector<Field>& fields() const { return fields_; }

private:
    static constexpr size_t kLongHeader = 160; ///< [byte] of blocks of another format

    void put(const void*, size_t size) override
    {
        if (size == 4 || size == 8)
            fields_.push_back({at_, size});
        else if (size > kLongHeader)
            for (size_t i = 0; i < kLongHeader; i += 4) {
                fields_.push_back({at_ + i, 4});
                if (i % 8 == 0)
                    fields_.push_back({at_ + i, 8});
            }
        at_ += size;
    }
    size_t at_ = 0;
    std::vector<Field> fields_;
};

/// The same state with the header that belongs to it.
void seal(std::vector<std::byte>& state)
{
    fx::scene::writeStateHeader(std::span<const std::byte>(state).subspan(kHeader), FX_VERSION, state.data());
}

class StateFields : public fx::test::ApiTest
{
protected:
    /// Two instances at different places.
    void add(const char* preset)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        ASSERT_EQ(fxLoadPresetLibrary(context_, preset, &def.preset), FX_OK) << fxGetLastErrorMessage();
        for (const double x : {0.0, 5.0}) {
            def.position[0] = x;
            FxInstanceId id{};
            ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        }
    }
    /// Of the state that the scene has now.
    std::vector<FieldFinder::Field> fields() const
    {
        FieldFinder finder;
        scene_->scene.save(finder);
        return finder.fields();
    }
    /// Restores and measures. @return FX_OK or not
    FxResult restoreMeasured(const std::vector<std::byte>& state)
    {
        fx::test::resetMeasuredNew();
        const FxResult result = restore(state);
        largest_ = fx::test::largestNew();
        highest_ = fx::test::highestNew();
        return result;
    }

    size_t largest_ = 0; ///< [byte]
    size_t highest_ = 0; ///< [byte]
};

} // namespace

TEST_F(StateFields, noNumberMakesARestoreTakeMemoryThatTheStateDoesNotFill)
{
    constexpr size_t kMaxTrials = 300; // of a preset
    for (const char* preset : {"fireworks", "magic-trail", "burning-debris", "gas-fire", "rain"}) {
        SCOPED_TRACE(preset);
        add(preset);
        play(6);
        const std::vector<std::byte> state = savedState();
        const uint64_t before = simulationHash();
        ASSERT_EQ(restoreMeasured(state), FX_OK) << fxGetLastErrorMessage();
        const size_t largest = std::max(largest_, 2 * state.size());
        const size_t highest = 2 * highest_ + 4 * state.size();
        const std::vector<FieldFinder::Field> all = fields();
        const size_t every = all.size() / kMaxTrials + 1;
        for (size_t i = 0; i < all.size(); i += i < kMaxTrials / 2 ? 1 : every) {
            const auto [offset, size] = all[i];
            const uint64_t huge[] = {~uint64_t(0), uint64_t(1) << 62, 0x00FFFFFF, 0x00100000};
            std::vector<std::byte> forged = state;
            std::memcpy(&forged[kHeader + offset], &huge[i % (size == 8 ? 4 : 3)], size);
            if (size == 4 && i % 3 == 1)
                std::memset(&forged[kHeader + offset], 0x7F, 1);
            seal(forged);
            const FxResult result = restoreMeasured(forged);
            ASSERT_LE(largest_, largest) << "field at " << offset;
            ASSERT_LE(highest_, highest) << "field at " << offset;
            if (result == FX_OK) {
                ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
            }
            ASSERT_EQ(simulationHash(), before) << "field at " << offset;
        }
    }
}

TEST_F(StateFields, aLongRestOfZerosIsRefusedWithoutMemoryForIt)
{
    std::vector<std::byte> state = savedState();
    const uint64_t before = simulationHash();
    // of an empty scene: rules, number of effects, next serial, size of the table of instances
    const std::vector<FieldFinder::Field> all = fields();
    state.resize(state.size() + (size_t(16) << 20));
    for (const auto& [offset, size] : all)
        for (const uint32_t count : {0x00FFFFFFu, 0x00300000u, 0xFFFFFFFFu}) {
            std::vector<std::byte> forged = state;
            std::memcpy(&forged[kHeader + offset], &count, 4);
            seal(forged);
            EXPECT_NE(restoreMeasured(forged), FX_OK);
            EXPECT_LT(highest_, size_t(1) << 20) << "field at " << offset;
        }
    EXPECT_EQ(simulationHash(), before);
}

TEST_F(StateFields, identitiesThatAreSpentTakeFewBytes)
{
    // a table of indices none of which can be used again, as far as the bytes go
    FxInstanceId id = addFountain();
    play(2);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    const std::vector<std::byte> state = savedState();
    const std::vector<FieldFinder::Field> all = fields();
    constexpr uint32_t kIndices = 1'000'000;
    size_t table = 0; // where its size is: before the use of its only index, which is 1, of four bytes
    for (size_t i = 0; i + 1 < all.size() && table == 0; ++i) {
        uint32_t size = 0, use = 0;
        std::memcpy(&size, &state[kHeader + all[i].offset], 4);
        std::memcpy(&use, &state[kHeader + all[i + 1].offset], 4);
        if (all[i].size == 4 && all[i + 1].size == 4 && size == 1 && use == 1)
            table = all[i].offset;
    }
    ASSERT_NE(table, 0u);
    const auto at = [&](size_t offset) { return state.begin() + std::ptrdiff_t(kHeader + offset); };
    std::vector<std::byte> forged(state.begin(), at(table));
    const auto put = [&](uint32_t word) {
        for (int i = 0; i < 4; ++i)
            forged.push_back(std::byte(word >> (8 * i)));
    };
    put(kIndices);
    for (uint32_t i = 0; i < kIndices; ++i) {
        put(uint32_t(fx::scene::kIdPartMask));
        forged.push_back(std::byte{0});
    }
    forged.insert(forged.end(), at(table + 4 + 5 + 4), state.end()); // without index and free list
    seal(forged);
    const FxResult result = restoreMeasured(forged);
    EXPECT_EQ(result, FX_OK) << fxGetLastErrorMessage();
    EXPECT_LT(highest_, 8 * forged.size());
    id = addFountain();
    EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
}
