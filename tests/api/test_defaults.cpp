#include "fxsdk/fx_defaults.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace {

template <class T>
void expectSame(FxResult (*get)(T*), const T& defaults)
{
    T filled;
    std::memset(&filled, 0xa5, sizeof filled);
    filled.structSize = sizeof filled;
    ASSERT_EQ(get(&filled), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(std::memcmp(&filled, &defaults, sizeof filled), 0); // no struct of the C API has padding
}

} // namespace

TEST(Defaults, areThoseOfTheInlineFunctions)
{
    expectSame(fxGetDefaultContextDef, fxDefaultContextDef());
    expectSame(fxGetDefaultSceneDef, fxDefaultSceneDef());
    expectSame(fxGetDefaultInstanceDef, fxDefaultInstanceDef());
    expectSame(fxGetDefaultInstanceParameters, fxDefaultInstanceParameters());
    expectSame(fxGetDefaultViewSettings, fxDefaultViewSettings());
    expectSame(fxGetDefaultFrameDef, fxDefaultFrameDef());
    expectSame(fxGetDefaultLight, fxDefaultLight());
    expectSame(fxGetDefaultFocus, fxDefaultFocus());
    expectSame(fxGetDefaultActivationHints, fxDefaultActivationHints());
    expectSame(fxGetDefaultBudget, fxDefaultBudget());
    expectSame(fxGetDefaultCollisionMesh, fxDefaultCollisionMesh());
    expectSame(fxGetDefaultContactHook, fxDefaultContactHook());
    expectSame(fxGetDefaultMotion, fxDefaultMotion());
}

TEST(Defaults, anOlderCallerGetsTheMembersThatItKnows)
{
    FxSceneDef def;
    std::memset(&def, 0x5a, sizeof def);
    def.structSize = 2 * sizeof(uint32_t); // structSize and maxInstances
    ASSERT_EQ(fxGetDefaultSceneDef(&def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(def.structSize, 2 * sizeof(uint32_t));
    EXPECT_EQ(def.maxInstances, fxDefaultSceneDef().maxInstances);
    EXPECT_EQ(def.hasGround, 0x5a5a5a5au); // beyond what it has
}

TEST(Defaults, refuseNullAndAnUnknownSize)
{
    EXPECT_EQ(fxGetDefaultViewSettings(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("ioSettings"), std::string::npos);
    FxViewSettings settings = {};
    EXPECT_EQ(fxGetDefaultViewSettings(&settings), FX_ERROR_VERSION);
    EXPECT_EQ(settings.slabs, 0u);
}
