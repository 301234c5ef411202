// Every preset of the library gives the same bits however it is computed. What one build cannot show, that
// compilers and their switches agree, scripts/check-all shows with the hashes that this program leaves beside
// itself.
#include "foundation/simd/instruction_set.h"
#include "tests/api/api_fixture.h"
#include "tests/api/library_names.h"
#include "tests/foundation/real_threads.h"

#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

using fx::base::InstructionSet;

namespace {

constexpr int kHalfSeconds = 4; // of play

/// How two seconds are computed.
struct Way
{
    uint32_t workers;
    std::vector<double> frames; ///< [s] repeated; whole repetitions make half a second
    InstructionSet widest;
    const char* what;
};

const Way kReference{1, {1.0 / 60}, InstructionSet::Avx512, "one worker, 60 Hz"};

std::vector<Way> otherWays()
{
    return {{2, {1.0 / 144}, InstructionSet::Sse4, "2 workers, 144 Hz, SSE4"},
            {3, {0.25 / 30, 0.0, 0.75 / 30}, InstructionSet::Avx2, "3 workers, uneven frames, AVX2"},
            {7, {1.0 / 30}, InstructionSet::Scalar, "7 workers, 30 Hz, no vectors"},
            {16, {1.0 / 60}, InstructionSet::Avx512, "16 workers, 60 Hz, the widest vectors"}};
}

void playHalfASecond(FxScene* scene, const std::vector<double>& frames)
{
    double length = 0.0;
    for (const double dt : frames)
        length += dt;
    const int repetitions = int(0.5 / length + 0.5);
    for (int i = 0; i < repetitions; ++i)
        for (const double dt : frames)
            EXPECT_EQ(fxScene_Update(scene, dt), FX_OK);
}

/// Hashes of what is seen and of the whole state, after every half second.
std::vector<uint64_t> play(const std::string& preset, const Way& way)
{
    fx::base::limitInstructionSet(way.widest);
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = way.workers;
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    EXPECT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    FxInstanceDef def = fxDefaultInstanceDef();
    EXPECT_EQ(fxLoadPresetLibrary(context, preset.c_str(), &def.preset), FX_OK);
    def.seed = 11;
    FxInstanceId id;
    EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
    std::vector<uint64_t> hashes;
    for (int i = 0; i < kHalfSeconds; ++i) {
        playHalfASecond(scene, way.frames);
        uint64_t seen = 0, whole = 0;
        EXPECT_EQ(fxScene_GetStateHash(scene, &seen), FX_OK);
        EXPECT_EQ(fxScene_GetSimulationHash(scene, &whole), FX_OK);
        hashes.insert(hashes.end(), {seen, whole});
    }
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    return hashes;
}

class LibraryDeterminism : public ::testing::Test
{
protected:
    ~LibraryDeterminism() override { fx::base::limitInstructionSet(widest_); }

    const InstructionSet widest_ = fx::base::instructionSet();
};

} // namespace

TEST_F(LibraryDeterminism, workersFramesAndVectorsChangeNoBitOfAnyPreset)
{
    const fx::test::RealThreads threadsOfAnyMachine(16);
    for (const std::string& name : fx::test::libraryNames()) {
        const std::vector<uint64_t> want = play(name, kReference);
        for (const Way& way : otherWays())
            EXPECT_EQ(play(name, way), want) << name << ": " << way.what;
    }
}

TEST_F(LibraryDeterminism, theHashesAreKeptForComparisonWithOtherBuilds)
{
    std::ofstream file(FX_LIBRARY_HASHES);
    for (const std::string& name : fx::test::libraryNames()) {
        file << name << std::hex << std::setfill('0');
        for (const uint64_t hash : play(name, kReference))
            file << ' ' << std::setw(16) << hash;
        file << std::endl; // line by line: what is there counts also when the rest takes too long
    }
    EXPECT_TRUE(file) << FX_LIBRARY_HASHES;
}
