// Parameters of instances by name and type.
#include "tests/api/api_fixture.h"

#include <cstring>
#include <limits>
#include <string>
#include <thread>

using namespace fx::test;

namespace {

class ParameterApi : public ApiTest
{
protected:
    ParameterApi() { id_ = addFountain(); }

    FxParameterId find(const char* name) const
    {
        FxParameterId parameter{};
        EXPECT_EQ(fxFindParameter(context_, fountain_, name, &parameter), FX_OK) << fxGetLastErrorMessage();
        return parameter;
    }
    FxResult set(const char* name, float value) const
    {
        return fxScene_SetParameter(scene_, id_, find(name), FX_PARAMETER_FLOAT, &value);
    }
    static bool saysLast(const char* text) { return std::strstr(fxGetLastErrorMessage(), text) != nullptr; }

    FxInstanceId id_{};
};

} // namespace

TEST_F(ParameterApi, oneParameterAfterTheOtherEqualsAllAtOnce)
{
    FxInstanceParameters all = fxDefaultInstanceParameters();
    all.intensity = 2.5f;
    all.wind[0] = 3.0f;
    all.wind[2] = -4.0f;
    all.emitting = 0;
    all.tint[1] = 0.25f;
    const FxInstanceId other = addFountain();
    ASSERT_EQ(fxScene_DestroyInstance(scene_, other), FX_OK);
    const uint64_t untouched = simulationHash();
    ASSERT_EQ(fxScene_SetParameters(scene_, id_, &all), FX_OK);
    ASSERT_EQ(fxScene_SetInstanceSpeed(scene_, id_, 1.5f), FX_OK);
    const uint64_t wanted = simulationHash();
    const FxInstanceParameters none = fxDefaultInstanceParameters();
    ASSERT_EQ(fxScene_SetParameters(scene_, id_, &none), FX_OK);
    ASSERT_EQ(fxScene_SetInstanceSpeed(scene_, id_, 1.0f), FX_OK);
    EXPECT_NE(untouched, wanted);
    ASSERT_EQ(set("intensity", 2.5f), FX_OK) << fxGetLastErrorMessage();
    const float wind[3] = {3.0f, 0.0f, -4.0f}, tint[3] = {1.0f, 0.25f, 1.0f};
    const uint32_t off = 0;
    ASSERT_EQ(fxScene_SetParameter(scene_, id_, find("wind"), FX_PARAMETER_FLOAT3, wind), FX_OK);
    ASSERT_EQ(fxScene_SetParameter(scene_, id_, find("tint"), FX_PARAMETER_FLOAT3, tint), FX_OK);
    ASSERT_EQ(fxScene_SetParameter(scene_, id_, find("emitting"), FX_PARAMETER_BOOL, &off), FX_OK);
    ASSERT_EQ(set("speed", 1.5f), FX_OK);
    EXPECT_EQ(simulationHash(), wanted);
}

TEST_F(ParameterApi, theInfosOfAPresetDescribeWhatCanBeSetAndRead)
{
    uint32_t count = 1;
    for (uint32_t i = 0; i < count; ++i) {
        FxParameterInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(fxGetParameterInfo(context_, fountain_, i, &info), FX_OK) << fxGetLastErrorMessage();
        count = info.count;
        EXPECT_EQ(find(info.name).bits, info.parameter.bits);
        const auto type = FxParameterType(info.type);
        float now[3] = {-7.0f, -7.0f, -7.0f}, most[3] = {info.maximum, info.maximum, info.maximum};
        uint32_t flag = 7;
        const bool isFlag = type == FX_PARAMETER_BOOL;
        void* const out = isFlag ? static_cast<void*>(&flag) : now;
        ASSERT_EQ(fxScene_GetParameter(scene_, id_, info.parameter, type, out), FX_OK)
            << fxGetLastErrorMessage();
        const size_t size = type == FX_PARAMETER_FLOAT3 ? 3 : 1;
        for (size_t k = 0; k < size; ++k)
            EXPECT_EQ(isFlag ? float(flag) : now[k], info.defaultValue[k]) << info.name;
        const uint32_t off = 0;
        ASSERT_EQ(fxScene_SetParameter(scene_, id_, info.parameter, type,
                                       isFlag ? static_cast<const void*>(&off) : most),
                  FX_OK)
            << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_GetParameter(scene_, id_, info.parameter, type, out), FX_OK);
        EXPECT_EQ(isFlag ? float(flag) : now[size - 1], isFlag ? 0.0f : info.maximum) << info.name;
    }
    EXPECT_EQ(count, 5u);
    FxParameterInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxGetParameterInfo(context_, fountain_, count, &info), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ParameterApi, mistakesAreExplainedAndChangeNothing)
{
    const uint64_t before = simulationHash();
    FxParameterId parameter{5};
    EXPECT_EQ(fxFindParameter(context_, fountain_, "intesity", &parameter), FX_ERROR_NOT_FOUND);
    EXPECT_TRUE(saysLast("did you mean \"intensity\"?")) << fxGetLastErrorMessage();
    EXPECT_EQ(parameter.bits, 5u);
    float number = 0.5f;
    EXPECT_EQ(fxScene_SetParameter(scene_, id_, find("wind"), FX_PARAMETER_FLOAT, &number),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(saysLast("\"wind\" is of type FX_PARAMETER_FLOAT3")) << fxGetLastErrorMessage();
    EXPECT_EQ(fxScene_SetParameter(scene_, id_, parameter, FX_PARAMETER_FLOAT, &number), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_SetParameter(scene_, id_, {}, FX_PARAMETER_FLOAT, &number), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_SetParameter(scene_, {}, find("speed"), FX_PARAMETER_FLOAT, &number),
              FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_SetParameter(scene_, id_, find("speed"), FX_PARAMETER_FLOAT, nullptr),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetParameter(scene_, id_, find("speed"), FX_PARAMETER_FLOAT, nullptr),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetParameter(scene_, id_, find("speed"), FX_PARAMETER_BOOL, &number),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(set("speed", 16.5f), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(saysLast("speed")) << fxGetLastErrorMessage();
    EXPECT_EQ(set("intensity", std::numeric_limits<float>::quiet_NaN()), FX_ERROR_INVALID_ARGUMENT);
    const uint32_t two = 2;
    EXPECT_EQ(fxScene_SetParameter(scene_, id_, find("emitting"), FX_PARAMETER_BOOL, &two),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxFindParameter(context_, {}, "speed", &parameter), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxFindParameter(nullptr, fountain_, "speed", &parameter), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxFindParameter(context_, fountain_, nullptr, &parameter), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxFindParameter(context_, fountain_, "speed", nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxParameterInfo info{};
    EXPECT_EQ(fxGetParameterInfo(context_, fountain_, 0, &info), FX_ERROR_VERSION);
    EXPECT_EQ(fxGetParameterInfo(context_, {}, 0, &info), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxGetParameterInfo(nullptr, fountain_, 0, &info), FX_ERROR_INVALID_ARGUMENT);
    const FxParameterId speed = find("speed");
    std::thread([&] {
        EXPECT_EQ(fxScene_SetParameter(scene_, id_, speed, FX_PARAMETER_FLOAT, &number),
                  FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetParameter(scene_, id_, speed, FX_PARAMETER_FLOAT, &number),
                  FX_ERROR_WRONG_THREAD);
    }).join();
    EXPECT_EQ(number, 0.5f);
    EXPECT_EQ(simulationHash(), before);
}
