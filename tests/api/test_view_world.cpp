// Pictures and lights of hosts of other units and axes: they are those of the library's own world.
#include "fxsdk/fx_view_lights.h"
#include "tests/api/host_convention.h"
#include "tests/api/view_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using fx::test::HostConvention;
using fx::test::kExactWorlds;
using fx::test::kLibraryWorld;
using fx::test::kRoundedWorlds;

namespace {

/// A flame to the right and smoke high on the left: no mirror image and no turn is the same.
constexpr const char* kAsymmetric = R"({"version": 1, "name": "asymmetric", "ground": false, "emitters": [
    {"layer": "fire", "position": [1, -0.5, 0], "shape": "sphere", "size": 0.25, "emission": {"rate": 60},
     "lifetime": 1, "radius": 0.4, "temperature": 1700, "fireShare": 0.5, "forces": {"gravity": 0}},
    {"layer": "dust", "position": [-1, 0.75, -0.5], "shape": "sphere", "size": 0.25, "emission": {"rate": 20},
     "lifetime": 1, "radius": 0.5, "albedoOverLife": [0.5, 0.5, 0.5], "forces": {"gravity": 0}},
    {"position": [0.25, 1, 0], "emission": {"rate": 40}, "lifetime": 1, "radius": 0.05, "speed": 2,
     "appearance": {"kind": "sprite", "alignment": "velocity", "blend": "additive"}}]})";

/// What a host got from one frame.
struct Drawn
{
    std::vector<float> picture;
    std::vector<FxLight> lights;
    FxMediaShadow sun{}, lamp{};
};

class ViewWorld : public fx::test::ViewApiTest
{
protected:
    /// Draws the same moment for a host of another world, and reads all lights.
    Drawn draw(const HostConvention& host, double rangeNear = 0.0)
    {
        FxContextDef contextDef = host.contextDef();
        contextDef.gl = {gl_->loader().user, gl_->loader().getProcAddress};
        FxContext* context = nullptr;
        EXPECT_EQ(fxCreateContext(&contextDef, &context), FX_OK) << fxGetLastErrorMessage();
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = fx::test::loadText(context, kAsymmetric);
        host.set(instance.position, host.vector({0.0, 0.25, -4.0}));
        const glm::quat turn = host.rotation(glm::quat(0.96f, 0.0f, 0.28f, 0.0f));
        const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
        std::copy_n(xyzw, 4, instance.rotation);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK) << fxGetLastErrorMessage();
        for (int i = 0; i < 30; ++i)
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);

        const FxViewSettings settings = sunny(host);
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        const FxLight lamp = lampOf(host);
        EXPECT_EQ(fxView_SetLights(view, &lamp, 1), FX_OK) << fxGetLastErrorMessage();
        FxFrameDef def = frameOf(host);
        def.rangeNear = float(rangeNear * host.unitsPerMeter);
        fillPicture();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        Drawn out;
        out.picture = picture();
        uint32_t count = 0;
        EXPECT_EQ(fxView_GetEffectLightCount(view, &count), FX_OK);
        for (uint32_t i = 0; i < count; ++i) {
            out.lights.emplace_back().structSize = sizeof(FxLight);
            EXPECT_EQ(fxView_GetEffectLight(view, i, &out.lights.back()), FX_OK);
        }
        out.sun.structSize = out.lamp.structSize = sizeof out.sun;
        EXPECT_EQ(fxView_GetMediaShadow(view, FX_LIGHT_SUN, 0, &out.sun), FX_OK);
        EXPECT_EQ(fxView_GetMediaShadow(view, FX_LIGHT_HOST, 0, &out.lamp), FX_OK);
        EXPECT_EQ(fxDestroyContext(context), FX_OK);
        return out;
    }

    FxFrameDef frameOf(const HostConvention& host) const
    {
        FxFrameDef def = frame();
        host.set(def.origin, host.vector({0.5, 0.0, 0.0}));
        glm::mat4 view = glm::translate(glm::mat4(1.0f), glm::vec3(0.5f, -0.25f, -0.5f));
        view[0] = {0.96f, 0.28f, 0.0f, 0.0f}; // rolled
        view[1] = {-0.28f, 0.96f, 0.0f, 0.0f};
        const glm::mat4 hostView = host.ofWorld(view, true);
        const glm::mat4 projection = host.projection(glm::make_mat4(def.projection));
        std::copy_n(glm::value_ptr(hostView), 16, def.view);
        std::copy_n(glm::value_ptr(projection), 16, def.projection);
        return def;
    }

    static FxViewSettings sunny(const HostConvention& host)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        host.set(settings.sunDirection, host.direction({0.64, 0.48, 0.6}));
        std::fill_n(settings.sunIlluminance, 3, 3e4f);
        std::fill_n(settings.skyLuminance, 3, 500.0f);
        return settings;
    }

    static FxLight lampOf(const HostConvention& host)
    {
        FxLight lamp = fxDefaultLight();
        host.set(lamp.position, host.vector({-2.0, 2.0, -4.5}));
        host.set(lamp.axis, host.direction({0.8, -0.6, 0.0}));
        lamp.radius = float(0.125 * host.unitsPerMeter);
        lamp.outerConeAngle = 1.0f;
        lamp.innerConeAngle = 0.5f;
        std::fill_n(lamp.intensity, 3, 2e5f);
        return lamp;
    }

    static float brightness(const std::vector<float>& picture, int fromX, int toX)
    {
        float sum = 0.0f;
        for (int y = 0; y < kSize; ++y)
            for (int x = fromX; x < toX; ++x)
                sum += std::min(picture[size_t(4 * (y * kSize + x))], 4.0f);
        return sum;
    }
};

/// Coordinates of a point among the planes of a parallel light, as the GLSL of the host computes them.
glm::dvec3 planesAt(const FxMediaShadow& shadow, const glm::dvec3& p)
{
    const auto row = [&](const float* r) {
        return glm::dot(glm::dvec3(glm::make_vec3(r)), p) + double(r[3]);
    };
    return {row(shadow.right[0]), row(shadow.up[0]), row(shadow.along[0])};
}

/// [m] way from a light at a point to `p`, in axes of its planes, as the GLSL computes it.
glm::dvec3 wayFrom(const FxMediaShadow& shadow, const glm::dvec3& p)
{
    const glm::dvec3 d = p - glm::dvec3(glm::make_vec3(shadow.place));
    glm::dvec3 out;
    for (int i = 0; i < 3; ++i)
        out[i] = glm::dot(glm::dvec3(glm::make_vec3(shadow.right[i])), d);
    return out;
}

} // namespace

TEST_F(ViewWorld, everyWorldHasTheSamePictureAndNoneIsMirrored)
{
    const Drawn expected = draw(kLibraryWorld);
    const float left = brightness(expected.picture, 0, kSize / 2);
    const float right = brightness(expected.picture, kSize / 2, kSize);
    ASSERT_GT(right, 1.2f * left); // the flame is on the right
    for (const HostConvention& host : kExactWorlds)
        EXPECT_EQ(draw(host).picture, expected.picture) << host;
    for (const HostConvention& host : kRoundedWorlds)
        EXPECT_LE(fx::test::largestShownDifference(draw(host).picture, expected.picture), 1.0f / 255.0f)
            << host;
}

TEST_F(ViewWorld, aRangeOfDepthIsInUnitsOfTheHost)
{
    const Drawn whole = draw(kLibraryWorld), cut = draw(kLibraryWorld, 4.0);
    ASSERT_GT(fx::test::largestShownDifference(whole.picture, cut.picture), 0.02f);
    EXPECT_EQ(draw(kExactWorlds[2], 4.0).picture, cut.picture);
}

TEST_F(ViewWorld, lightsOfEffectsAreWhereTheHostSeesThem)
{
    const Drawn expected = draw(kLibraryWorld);
    ASSERT_FALSE(expected.lights.empty());
    for (const HostConvention& host : kExactWorlds) {
        SCOPED_TRACE(host);
        const Drawn drawn = draw(host);
        ASSERT_EQ(drawn.lights.size(), expected.lights.size());
        for (size_t i = 0; i < drawn.lights.size(); ++i) {
            const FxLight &light = drawn.lights[i], &known = expected.lights[i];
            EXPECT_EQ(glm::make_vec3(light.position), host.vector(glm::make_vec3(known.position)));
            EXPECT_EQ(glm::make_vec3(light.intensity),
                      glm::make_vec3(known.intensity)); // [cd] in every world
            EXPECT_EQ(double(light.radius), double(known.radius) * host.unitsPerMeter);
            EXPECT_EQ(glm::dvec3(glm::make_vec3(light.axis)), host.direction({0.0, -1.0, 0.0}));
        }
    }
}

TEST_F(ViewWorld, theShadowOfMediaIsLookedUpAtPositionsOfTheHost)
{
    const Drawn expected = draw(kLibraryWorld);
    ASSERT_NE(expected.sun.texture, 0u);
    ASSERT_NE(expected.lamp.texture, 0u);
    const glm::dvec3 p(0.75, -1.0, -3.5);
    EXPECT_LT(
        glm::length(wayFrom(expected.lamp, p) - (glm::dvec3(0.5, 0, 0) + p - glm::dvec3(-2.0, 2.0, -4.5))),
        1e-5);
    for (const HostConvention& host : kExactWorlds) {
        SCOPED_TRACE(host);
        const Drawn drawn = draw(host);
        const glm::dvec3 hostP = host.vector(p);
        EXPECT_LT(glm::length(planesAt(drawn.sun, hostP) - planesAt(expected.sun, p)), 1e-4);
        EXPECT_LT(glm::length(wayFrom(drawn.lamp, hostP) - wayFrom(expected.lamp, p)), 1e-5);
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(drawn.lamp.along[0][i], expected.lamp.along[0][i]); // in meters
    }
}

TEST_F(ViewWorld, aMirroringViewMatrixIsRefused)
{
    FxFrameDef def = frame();
    def.view[10] = -1.0f;
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("frame.view mirrors the world"), std::string::npos)
        << fxGetLastErrorMessage();
}
