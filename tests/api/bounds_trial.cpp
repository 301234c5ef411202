#include "tests/api/bounds_trial.h"

#include "tests/api/projected_hull.h"
#include "tests/presets/small_png.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace {

constexpr double kMargin = 1.5; ///< [pixel] what is smaller than a pixel is widened to one
constexpr double kNear = 0.08;  ///< [m]
constexpr double kFar = 500.0;  ///< [m]

glm::dvec3 randomVector(Dice& dice)
{
    return {dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)};
}

glm::dquat rotationOf(const FxInstanceDef& def)
{
    return {double(def.rotation[3]), double(def.rotation[0]), double(def.rotation[1]),
            double(def.rotation[2])};
}

void setRotation(const glm::dquat& q, FxInstanceDef& io)
{
    const double xyzw[] = {q.x, q.y, q.z, q.w};
    for (int i = 0; i < 4; ++i)
        io.rotation[i] = float(xyzw[i]);
}

glm::dvec3 positionOf(const FxInstanceDef& def)
{
    return glm::make_vec3(def.position);
}

/// Corners of the smallest box around points.
struct Span
{
    glm::dvec3 low{1e300}, high{-1e300};
    explicit Span(const std::vector<glm::dvec3>& points)
    {
        for (const glm::dvec3& p : points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    glm::dvec3 middle() const { return 0.5 * (low + high); }
    double radius() const { return 0.5 * glm::length(high - low); }
};

std::vector<glm::dvec3> seenBy(const TrialCamera& camera, std::vector<glm::dvec3> corners)
{
    for (glm::dvec3& corner : corners)
        corner = glm::dvec3(camera.view * glm::dvec4(corner - camera.origin, 1.0));
    return corners;
}

/// [pixel] radius of the ball around points on a picture of 2 * `half` pixels; infinite from inside.
double radiusOnPicture(const TrialCamera& camera, const std::vector<glm::dvec3>& eye, double half)
{
    const Span span(eye);
    const double distance = glm::length(span.middle());
    if (!camera.isParallel && distance <= span.radius())
        return 1e300;
    return span.radius() * half * camera.projection[1][1] / (camera.isParallel ? 1.0 : distance);
}

} // namespace

BoundsTrialTest::BoundsTrialTest()
{
    folder_.write("spot.png", smallPng());
    folder_.write("lump.obj", lumpObj());
    folder_.write("cloud.fxgrid", cloudGrid());
    folder_.write("wind.fxgrid", windGrid());
    Dice dice(1);
    for (int i = 0; i < kSize * kSize; ++i)
        for (const float value : {float(dice.between(0.2, 0.3)), kBackground, kBackground, 1.0f})
            pattern_.push_back(value);
    EXPECT_EQ(fxDestroyView(view_), FX_OK);
    FxSceneDef sceneDef = fxDefaultSceneDef();
    sceneDef.maxFrameTicks = 10 * FX_TICKS_PER_SECOND;
    EXPECT_EQ(fxCreateScene(context_, &sceneDef, &own_), FX_OK);
    EXPECT_EQ(fxCreateView(context_, own_, nullptr, &view_), FX_OK) << fxGetLastErrorMessage();
}

FxPresetId BoundsTrialTest::load(const std::string& text)
{
    FxPresetId preset{};
    const std::string file = folder_.write("preset.fx.json", text);
    EXPECT_EQ(fxLoadPresetFile(context_, file.c_str(), &preset), FX_OK) << fxGetLastErrorMessage() << "\n"
                                                                        << text;
    return preset;
}

FxInstanceDef BoundsTrialTest::randomInstance(Dice& dice, FxPresetId preset) const
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = preset;
    def.seed = dice.below(1000);
    def.scale = float(dice.one(2) ? 1.0 : dice.magnitude(0.2, 5));
    for (double& p : def.position)
        p = dice.between(-1, 1) * (dice.one(4) ? 1e5 : 3.0);
    if (dice.one(2))
        setRotation(glm::normalize(glm::dquat(dice.between(0.1, 1), randomVector(dice))), def);
    def.intensity = float(dice.one(4) ? dice.between(0.2, 2) : 1.0);
    if (dice.one(4))
        def.wind[0] = float(dice.between(-3, 3));
    return def;
}

/// Emitters are computed on the GPU when a view has drawn lately and no reader has requested rows.
void BoundsTrialTest::waitForGpu()
{
    constexpr int kUpdates = 241;
    for (int i = 0; i < kUpdates; ++i)
        ASSERT_EQ(fxScene_Update(own_, 0.0), FX_OK) << fxGetLastErrorMessage();
    FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
}

void BoundsTrialTest::move(Dice& dice, FxInstanceId id, FxInstanceDef& io)
{
    for (double& p : io.position)
        p += dice.between(-0.3, 0.3);
    if (dice.one(2))
        setRotation(glm::normalize(rotationOf(io) * glm::dquat(1.0, 0.2 * randomVector(dice))), io);
    if (dice.one(2))
        io.scale *= float(dice.magnitude(0.8, 1.25));
    ASSERT_EQ(fxScene_SetTransform(own_, id, io.position, io.rotation, io.scale), FX_OK)
        << fxGetLastErrorMessage();
}

void BoundsTrialTest::changeWind(Dice& dice, FxInstanceId id, const FxInstanceDef& def)
{
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.intensity = def.intensity;
    for (float& w : parameters.wind)
        w = float(dice.one(2) ? 0.0 : dice.between(-8, 8));
    ASSERT_EQ(fxScene_SetParameters(own_, id, &parameters), FX_OK) << fxGetLastErrorMessage();
}

/// Plays to a moment between two steps; the host moves the instance on the way.
void BoundsTrialTest::play(Dice& dice, bool moves, FxInstanceId id, FxInstanceDef& io)
{
    const double moment = dice.magnitude(0.03, 2.5);
    ASSERT_EQ(fxScene_Update(own_, 0.3 * moment), FX_OK) << fxGetLastErrorMessage();
    if (dice.one(4))
        changeWind(dice, id, io);
    if (dice.one(4)) {
        ASSERT_EQ(fxScene_SetInstanceSpeed(own_, id, float(dice.magnitude(0.2, 8))), FX_OK);
    }
    ASSERT_EQ(fxScene_Update(own_, 0.3 * moment), FX_OK);
    if (dice.one(4))
        changeWind(dice, id, io);
    constexpr int kMoves = 3;
    for (int i = 0; i < kMoves; ++i) { // the last is that of a single step, and a frame lies within it
        const double seconds = i + 1 < kMoves ? 0.2 * moment : dice.between(1.0, 2.0) / 60.0;
        const glm::dvec3 before = positionOf(io);
        const double reachBefore = reachOf(id);
        if (moves)
            move(dice, id, io);
        ASSERT_EQ(fxScene_Update(own_, seconds), FX_OK);
        ball_.center = positionOf(io); // frames lie between both steps
        moved_ = glm::length(positionOf(io) - before);
        ball_.radius = std::max(reachBefore, reachOf(id)) + moved_;
    }
}

double BoundsTrialTest::reachOf(FxInstanceId id)
{
    FxInstanceActivity activity{};
    activity.structSize = sizeof activity;
    EXPECT_EQ(fxScene_GetInstanceActivity(own_, id, &activity), FX_OK) << fxGetLastErrorMessage();
    return double(activity.reach);
}

/// Looks at the body from somewhere, perhaps from inside; or along an axis of its own, where its box is
/// seen from the side.
TrialCamera BoundsTrialTest::randomCamera(Dice& dice, bool isAligned, double farther,
                                          const std::vector<glm::dvec3>& corners) const
{
    const Span span(corners);
    TrialCamera camera;
    const double size = span.radius() + 0.05;
    const int axis = int(dice.below(3));
    glm::dvec3 from = randomVector(dice) + 1e-3, up = randomVector(dice) * glm::dvec3(1, 0, 1);
    up.y = 1.1;
    if (isAligned)
        for (int i = 0; i < 3; ++i) {
            from[i] = i == axis;
            up[i] = i == (axis + 1) % 3;
        }
    from = rotationOf(def_) * glm::normalize(from);
    up = rotationOf(def_) * glm::normalize(up);
    camera.origin = span.middle() + from * size * (isAligned ? 4.0 : farther * dice.magnitude(0.2, 6));
    const glm::dvec3 aim =
        span.middle() - camera.origin + (isAligned ? 0.0 : 0.4) * size * randomVector(dice);
    camera.view = glm::dmat4(glm::mat4(glm::lookAt(glm::dvec3(0.0), aim, up)));
    camera.isParallel = dice.one(isAligned ? 2 : 6);
    const double half = size * (isAligned ? 1.0 : dice.magnitude(0.5, 4));
    const double angle = isAligned ? 0.56 : dice.between(0.3, 2.0);
    camera.projection =
        camera.isParallel ? glm::ortho(-half, half, -half, half, kNear, kFar)
                          : glm::perspective(angle, isAligned ? 1.0 : dice.magnitude(0.6, 1.6), kNear, kFar);
    camera.projection = glm::dmat4(glm::mat4(camera.projection));
    return camera;
}

FxViewSettings BoundsTrialTest::setView(Dice& dice, bool isSharp)
{
    FxViewSettings settings = fxDefaultViewSettings();
    // What a saturated pixel has too much goes to all pixels of the picture: the glare of a sensor has no
    // place in the world, and no bounds but the picture's.
    settings.dazzle = 0;
    if (isSharp) {
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
        return settings;
    }
    settings.shimmerStrength = dice.one(2) ? 0.0f : float(dice.between(1, 10));
    settings.shimmerMaxOffset = 100;
    settings.layerScale = dice.one(6) ? 0.5f : dice.one(12) ? 0.25f : 1.0f;
    settings.lodBias = dice.one(3) ? float(dice.magnitude(1, 256)) : 0.0f;
    settings.lodImpostorPixels = dice.one(4) ? 13.0f : 0.0f;
    EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    return settings;
}

void BoundsTrialTest::fillPattern()
{
    host_->gl.TextureSubImage2D(color_.name(), 0, 0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, pattern_.data());
}

std::vector<glm::dvec2> BoundsTrialTest::draw(const TrialCamera& camera)
{
    FxFrameDef def = frame();
    def.deltaTime = 1.0; // longer than anything fades
    for (int i = 0; i < 3; ++i)
        def.origin[i] = camera.origin[i];
    const glm::mat4 view(camera.view), projection(camera.projection);
    std::copy_n(glm::value_ptr(view), 16, def.view);
    std::copy_n(glm::value_ptr(projection), 16, def.projection);
    fillPattern();
    EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> seen = picture();
    std::vector<glm::dvec2> changed;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const size_t at = size_t(y * kSize + x) * 4;
            if (std::abs(seen[at] - pattern_[at]) >= 1e-5f ||
                std::abs(seen[at + 1] - pattern_[at + 1]) >= 1e-5f)
                changed.emplace_back(x + 0.5, y + 0.5);
        }
    return changed;
}

/// [m] how far the ray of a pixel passes by a ball at most, less the ball's radius and the pixel.
double BoundsTrialTest::beyond(const TrialBall& ball) const
{
    const glm::dmat4 back = glm::inverse(camera_.projection * camera_.view);
    double farthest = -1e300;
    for (const glm::dvec2& pixel : pixels_) {
        const auto at = [&](double depth) {
            const glm::dvec4 p = back * glm::dvec4(2.0 * pixel / double(kSize) - 1.0, depth, 1.0);
            return glm::dvec3(p) / p.w;
        };
        const glm::dvec3 begin = at(-1.0), way = glm::normalize(at(0.0) - begin);
        const glm::dvec3 to = ball.center - camera_.origin - begin;
        const double along = std::max(glm::dot(to, way), 0.0);
        const double scale = camera_.projection[0][0] / (camera_.isParallel ? 1.0 : along + kNear);
        const double width = 2.0 / double(kSize) /
                             std::min(scale, scale * camera_.projection[1][1] / camera_.projection[0][0]);
        farthest = std::max(farthest, glm::length(to - along * way) - ball.radius - 2.0 * slack_ * width);
    }
    return farthest;
}

void BoundsTrialTest::compare(const PublishedBoxes& boxes, const TrialCamera& camera, TrialResult& io) const
{
    for (size_t what = 0; what < io.by.size(); ++what) {
        const auto eye = seenBy(camera, cornersOf(boxes.boxes(Without(what))));
        const ProjectedHull hull(eye, camera.projection, kNear, glm::dvec2(kSize));
        for (const glm::dvec2& pixel : pixels_)
            io.by[what] = std::max(io.by[what], hull.distance(pixel));
        if (Without(what) != Without::Nothing || hull.empty() || pixels_.size() < 20)
            continue;
        io.isCut = std::any_of(eye.begin(), eye.end(), [](const glm::dvec3& p) { return -p.z < kNear; });
        glm::dvec2 low(kSize), high(0.0);
        for (const glm::dvec2& pixel : pixels_) {
            low = glm::min(low, pixel - 0.5);
            high = glm::max(high, pixel + 0.5);
        }
        const glm::dvec2 size = hull.high() - hull.low(), drawn = high - low;
        const bool isWhole =
            hull.low().x >= 0.0 && hull.low().y >= 0.0 && hull.high().x <= kSize && hull.high().y <= kSize;
        if (isWhole)
            io.tightness = std::sqrt(size.x * size.y / (drawn.x * drawn.y));
    }
}

void BoundsTrialTest::look(const PublishedBoxes& boxes, const FxViewSettings& settings, Dice& dice,
                           bool isSharp, TrialResult& io)
{
    const std::vector<glm::dvec3> corners = cornersOf(boxes.boxes(Without::Nothing));
    if (corners.empty())
        return;
    const bool showsPictures = settings.lodImpostorPixels > 0.0f; // of what is far, from the second frame on
    camera_ =
        randomCamera(dice, isSharp || (dice.one(2) && !showsPictures), showsPictures ? 8.0 : 1.0, corners);
    if (showsPictures)
        draw(camera_);
    pixels_ = draw(camera_);
    const double texel = 1.0 / double(settings.layerScale); // those of smaller layers are blended
    slack_ = kMargin * texel + (texel > 1.0 ? texel : 0.0);
    const double bias = double(settings.lodBias); // those that stand for others grow, see lod-weight
    if (bias > 0.0)
        slack_ += std::min(1.15 * std::sqrt(bias),
                           0.1 * radiusOnPicture(camera_, seenBy(camera_, corners), 0.5 * kSize));
    io.slack = slack_;
    compare(boxes, camera_, io);
    if (bias > 0.0)
        io.tightness = 0;
    double farthest = 0;
    for (const glm::dvec3& corner : corners)
        farthest = std::max(farthest, glm::length(corner - ball_.center));
    io.room = ball_.radius / farthest;
    io.beyond = beyond(ball_);
    const FxViewStatistics seen = statistics();
    io.onGpu = seen.gpuParticles;
    io.thinned = seen.blobsThinned + uint32_t(seen.particlesThinned);
    io.pictures = seen.impostors;
}

TrialResult BoundsTrialTest::tryOne(uint64_t seed, bool isSharp)
{
    Dice dice(seed);
    TrialResult result;
    result.preset =
        isSharp ? sharpPreset(seed) : randomPreset(seed, FXSDK_WITH_GPU_PARTICLES, FXSDK_WITH_SPH);
    def_ = randomInstance(dice, load(result.preset.text));
    const FxViewSettings settings = setView(dice, isSharp);
    if (result.preset.kind == "gpu")
        waitForGpu();
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(own_, &def_, &id), FX_OK) << fxGetLastErrorMessage();
    play(dice, isSharp ? seed % 2 == 0 : dice.one(3), id, def_);
    result.reach = ball_.radius;
    pixels_.clear();
    look(PublishedBoxes(own_), settings, dice, isSharp, result);
    result.drawn = int(pixels_.size());
    EXPECT_EQ(fxScene_DestroyInstance(own_, id), FX_OK);
    EXPECT_EQ(fxUnloadPreset(context_, def_.preset), FX_OK);
    return result;
}

double BoundsTrialTest::beyondReachOf(const std::string& text)
{
    FxInstanceDef def = def_;
    def.preset = load(text);
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(own_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    const TrialBall ball{ball_.center, reachOf(id) + moved_};
    EXPECT_EQ(fxScene_DestroyInstance(own_, id), FX_OK);
    EXPECT_EQ(fxUnloadPreset(context_, def.preset), FX_OK);
    return beyond(ball);
}

} // namespace fx::test
