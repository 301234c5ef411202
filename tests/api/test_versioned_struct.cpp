#include "fxsdk/api/versioned_struct.h"
#include "tests/api/api_fixture.h"

#include <cstddef>
#include <cstring>

using fx::base::Code;

namespace {

/// A description as version 2 of a library knows it; version 1 ended before `b`.
struct Grown
{
    uint32_t structSize;
    float a;
    float b;
    uint32_t c;
};
constexpr Grown kDefaults{sizeof(Grown), 1.0f, 2.0f, 3};

/// What a caller hands over whose struct has `size` bytes.
struct Caller
{
    alignas(8) unsigned char bytes[64] = {};
    explicit Caller(uint32_t size) { std::memcpy(bytes, &size, sizeof size); }
    Grown* as() { return reinterpret_cast<Grown*>(bytes); }
};

} // namespace

TEST(VersionedStruct, whatAnOlderCallerDoesNotKnowHasItsDefault)
{
    Caller old(8);
    const float a = 7.0f;
    std::memcpy(old.bytes + 4, &a, sizeof a);
    Grown out{};
    ASSERT_TRUE(fx::api::readStruct(old.as(), "old", kDefaults, out).ok());
    EXPECT_EQ(out.a, 7.0f);
    EXPECT_EQ(out.b, 2.0f);
    EXPECT_EQ(out.c, 3u);
}

TEST(VersionedStruct, aNewerCallerIsTakenWhileWhatIsUnknownIsZero)
{
    Caller newer(32);
    Grown out{};
    EXPECT_TRUE(fx::api::readStruct(newer.as(), "newer", kDefaults, out).ok());
    newer.bytes[31] = 1;
    EXPECT_EQ(fx::api::readStruct(newer.as(), "newer", kDefaults, out).code(), Code::Version);
    newer.bytes[31] = 0;
    newer.bytes[sizeof(Grown)] = 1;
    EXPECT_EQ(fx::api::readStruct(newer.as(), "newer", kDefaults, out).code(), Code::Version);
}

TEST(VersionedStruct, sizesThatNoVersionCanHaveAreRefused)
{
    for (const uint32_t size : {0u, 4u, 9u, 18u, 4100u, 0xFFFFFFFFu}) {
        Caller caller(size);
        Grown out = kDefaults;
        EXPECT_EQ(fx::api::readStruct(caller.as(), "caller", kDefaults, out).code(), Code::Version) << size;
        EXPECT_EQ(fx::api::writeStruct(kDefaults, caller.as(), "caller").code(), Code::Version) << size;
    }
    Grown out{};
    const Grown* none = nullptr;
    EXPECT_EQ(fx::api::readStruct(none, "none", kDefaults, out).code(), Code::InvalidArgument);
}

TEST(VersionedStruct, writingStaysInsideTheCallersStructAndZeroesWhatIsUnknown)
{
    Caller old(12);
    std::memset(old.bytes + 4, 0xEE, 60);
    ASSERT_TRUE(fx::api::writeStruct(kDefaults, old.as(), "old").ok());
    EXPECT_EQ(old.as()->structSize, 12u);
    EXPECT_EQ(old.as()->b, 2.0f);
    EXPECT_EQ(old.bytes[12], 0xEE);

    Caller newer(24);
    std::memset(newer.bytes + 4, 0xEE, 60);
    ASSERT_TRUE(fx::api::writeStruct(kDefaults, newer.as(), "newer").ok());
    EXPECT_EQ(newer.as()->c, 3u);
    EXPECT_EQ(newer.bytes[16], 0);
    EXPECT_EQ(newer.bytes[23], 0);
    EXPECT_EQ(newer.bytes[24], 0xEE);
}

using VersionedApi = fx::test::ApiTest;
using fx::test::kFrame;

TEST_F(VersionedApi, anApplicationBuiltWithoutTheSeedStillPlacesInstances)
{
    struct OldInstanceDef // FxInstanceDef up to and without `seed`
    {
        uint32_t structSize;
        float scale;
        FxPresetId preset;
        double position[3];
        float rotation[4];
        int64_t startTick;
    };
    static_assert(sizeof(OldInstanceDef) == offsetof(FxInstanceDef, seed));
    OldInstanceDef old{sizeof(OldInstanceDef), 1.0f, fountain_, {0, 0, 0}, {0, 0, 0, 1}, 0};
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, reinterpret_cast<const FxInstanceDef*>(&old), &id), FX_OK)
        << fxGetLastErrorMessage();
    fxScene_Update(scene_, kFrame);
    fxScene_Update(scene_, kFrame);
    EXPECT_GT(statistics().born, 0u); // intensity and emitting came from the defaults, not from zero
}

TEST_F(VersionedApi, aStructWithMembersOfTheFutureIsRefusedUnlessTheyAreZero)
{
    struct NewSceneDef
    {
        FxSceneDef known;
        uint64_t future;
    };
    NewSceneDef def{fxDefaultSceneDef(), 0};
    def.known.structSize = sizeof def;
    FxScene* scene = nullptr;
    EXPECT_EQ(fxCreateScene(context_, &def.known, &scene), FX_OK);
    FxScene* other = nullptr;
    def.future = 1;
    EXPECT_EQ(fxCreateScene(context_, &def.known, &other), FX_ERROR_VERSION);
    EXPECT_EQ(other, nullptr);
}
