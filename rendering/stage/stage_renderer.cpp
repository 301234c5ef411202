#include "rendering/stage/stage_renderer.h"

#include "rendering/frame/exposure.h"
#include "rendering/frame/hill_colors.h"
#include "rendering/frame/view_block.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_state_guard.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/gl/gl_unpack_scope.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

constexpr int kShadowSize = 2048;    // [pixel]
constexpr float kShadowBias = 3e-4f; // of the depth of the map

constexpr ProgramDesc kMeshProgram{"stage mesh", "stage/stage_mesh.vert.glsl", "stage/stage_mesh.frag.glsl",
                                   nullptr, nullptr};
constexpr ProgramDesc kShadowProgram{"stage shadow", "stage/stage_shadow.vert.glsl",
                                     "stage/stage_shadow.frag.glsl", nullptr, nullptr};
constexpr ProgramDesc kBackgroundProgram{"stage background", "shared/fullscreen.vert.glsl",
                                         "stage/stage_background.frag.glsl", nullptr, nullptr};

/// Layout of StageLight in shaders/stage/stage_block.glsl.
struct StageLightBlock
{
    glm::vec4 position, intensity, cone, traits;
};

/// Layout of StageBlock in shaders/stage/stage_block.glsl.
struct StageBlock
{
    glm::mat4 clipFromWorld;
    glm::mat4 shadowFromMesh;
    glm::vec4 rayDirection, rayDirectionX, rayDirectionY;
    glm::vec4 sunDirection, sunLight, skyLight;
    glm::vec4 meshOffset, background, horizon, farHills, nearTrees, water;
    std::array<StageLightBlock, kMaxStageLights> lights;
    std::array<MediaShadowBlock, kMaxStageShadows> mediaShadows;
};
static_assert(sizeof(StageBlock) == 128 + 12 * 16 + sizeof(StageLightBlock) * kMaxStageLights +
                                        sizeof(MediaShadowBlock) * kMaxStageShadows);

/// Cone of a spot, as in shaders/shared/light_slices.glsl.
glm::vec4 coneOf(const HostLight& light)
{
    if (light.cosOuter <= -1.0f)
        return {0.0f, 0.0f, 0.0f, 1.0f};
    const float scale = 1.0f / std::max(light.cosInner - light.cosOuter, 1e-4f);
    return {light.axis * scale, -light.cosOuter * scale};
}

struct BoundingBall
{
    glm::vec3 center{0.0f};
    float radius = 1.0f;
};

BoundingBall boundingBall(std::span<const glm::vec3> points)
{
    base::Bounds bounds;
    for (const glm::vec3& p : points)
        bounds.add(p, 0.0f);
    if (bounds.empty())
        return {};
    return {0.5f * (bounds.min + bounds.max), std::max(0.5f * glm::length(bounds.max - bounds.min), 1e-3f)};
}

/// Clip space of the sun around a ball.
glm::mat4 sunClip(const BoundingBall& ball, const glm::vec3& direction)
{
    const glm::vec3 up =
        std::abs(direction.y) > 0.99f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::mat4 view = glm::lookAt(ball.center + direction * (2.0f * ball.radius), ball.center, up);
    const float r = ball.radius;
    return glm::orthoRH_NO(-r, r, -r, r, r, 3.0f * r) * view;
}

} // namespace

struct StageRenderer::Impl
{
    explicit Impl(GlDevice* d) : device(d), graph(d->memory()), backend(*d, d->memory()) {}

    base::Status prepareTargets(int width, int height);
    base::Status prepareShadow();
    StageBlock makeBlock(const CameraView& camera, const StageLighting& lit, float exposure, int width,
                         int height) const;
    void setLights(const CameraView& camera, const StageLighting& lit, float exposure,
                   StageBlock& ioBlock) const;
    void addShadowPass(ResourceId meshBuffer, const StageBlock& block);
    void addPicturePass(ResourceId meshBuffer, const StageBlock& block, DepthConvention depth,
                        uint32_t mediaShadows);

    GlDevice* device;
    FrameGraph graph;
    GlBackend backend;
    GlTexture color, depth, picture, shadow, shadowDepth;
    GlBuffer mesh;
    glm::dvec3 meshOrigin{0.0};
    bool isSoil = false;
    uint32_t vertices = 0;
    uint32_t solids = 0;  ///< vertices in front of those of water
    uint32_t casters = 0; ///< vertices, from the first on, that cast shadows
    BoundingBall ball;
    StageBackground background;
    glm::vec3 shadowDirection{0.0f}; ///< of the shadow map that exists; zero: none
    ResourceId shadowMap;            ///< in the graph being built
};

StageLight effectStageLight(const EffectLight& light)
{
    StageLight result;
    result.light.position = light.position;
    result.light.intensity = light.intensity;
    result.light.radius = light.radius;
    result.wrap = 0.2f;
    return result;
}

StageRenderer::StageRenderer(GlDevice* device) : impl_(std::make_unique<Impl>(device)) {}
StageRenderer::~StageRenderer() = default;
uint32_t StageRenderer::colorTexture() const
{
    return impl_->color.name();
}
uint32_t StageRenderer::depthTexture() const
{
    return impl_->depth.name();
}

HostShadowMap StageRenderer::sunShadow(const glm::dvec3& origin) const
{
    const Impl& s = *impl_;
    HostShadowMap map;
    if (s.vertices == 0 || s.shadowDirection == glm::vec3(0.0f))
        return map;
    map.texture = s.shadowDepth.name();
    const glm::mat4 half = glm::translate(glm::mat4(1.0f), glm::vec3(0.5f, 0.5f, 0.5f - kShadowBias)) *
                           glm::scale(glm::mat4(1.0f), glm::vec3(0.5f));
    map.fromWorld = half * sunClip(s.ball, s.shadowDirection) *
                    glm::translate(glm::mat4(1.0f), glm::vec3(origin - s.meshOrigin));
    map.edge = std::max(0.05f, 2.0f * (2.0f * s.ball.radius / float(kShadowSize)));
    return map;
}

base::Status StageRenderer::setMesh(const StageMesh& mesh)
{
    if (mesh.positions.size() != mesh.normals.size() || mesh.positions.size() != mesh.colors.size())
        return {base::Code::InvalidArgument, "stage mesh: positions, normals and colors differ in number"};
    std::vector<float> data;
    data.reserve(mesh.positions.size() * 9);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        for (const glm::vec3* v : {&mesh.positions[i], &mesh.normals[i], &mesh.colors[i]})
            data.insert(data.end(), {v->x, v->y, v->z});
    GlBuffer buffer;
    if (!data.empty()) {
        auto created = GlBuffer::create(*impl_->device, data.size() * sizeof(float), "stage mesh");
        if (!created)
            return created.status();
        buffer = std::move(*created);
        impl_->device->gl.NamedBufferSubData(buffer.name(), 0, GLsizeiptr(buffer.bytes()), data.data());
    }
    impl_->mesh = std::move(buffer);
    impl_->vertices = uint32_t(mesh.positions.size());
    impl_->meshOrigin = mesh.origin;
    impl_->isSoil = mesh.isSoil;
    // Flat ground shades nothing. A map over all of it would be too coarse for a figure.
    const bool onlyAdded = mesh.isSoil && mesh.addedVertices() > 0;
    impl_->solids = uint32_t(mesh.positions.size() - std::min(mesh.waterVertices, mesh.positions.size()));
    impl_->casters = onlyAdded ? uint32_t(mesh.addedVertices()) : impl_->solids;
    impl_->ball = boundingBall(std::span(mesh.positions).first(impl_->casters));
    impl_->shadowDirection = glm::vec3(0.0f);
    return {};
}

base::Status StageRenderer::setBackground(const StageBackground& background)
{
    GlTexture picture;
    if (!background.image.empty()) {
        if (background.image.size() != size_t(background.width) * size_t(background.height))
            return {base::Code::InvalidArgument,
                    "stage background: the image does not have width x height pixels"};
        auto created =
            GlTexture::create(*impl_->device, background.width, background.height, GL_RGB32F, "background");
        if (!created)
            return created.status();
        picture = std::move(*created);
        const GlUnpackScope unpack(impl_->device->gl);
        for (int row = 0; row < background.height; ++row) // GL counts rows from the bottom
            impl_->device->gl.TextureSubImage2D(
                picture.name(), 0, 0, background.height - 1 - row, background.width, 1, GL_RGB, GL_FLOAT,
                background.image.data() + size_t(row) * size_t(background.width));
    }
    impl_->picture = std::move(picture);
    impl_->background = background;
    impl_->background.image.clear();
    return {};
}

base::Status StageRenderer::Impl::prepareTargets(int width, int height)
{
    if (color.width() == width && color.height() == height)
        return {};
    auto newColor = GlTexture::create(*device, width, height, GL_RGBA32F, "stage color");
    if (!newColor)
        return newColor.status();
    auto newDepth = GlTexture::create(*device, width, height, GL_DEPTH_COMPONENT32F, "stage depth");
    if (!newDepth)
        return newDepth.status();
    color = std::move(*newColor);
    depth = std::move(*newDepth);
    return {};
}

base::Status StageRenderer::Impl::prepareShadow()
{
    if (shadow.name() != 0)
        return {};
    auto newShadow = GlTexture::create(*device, kShadowSize, kShadowSize, GL_R32F, "stage shadow");
    if (!newShadow)
        return newShadow.status();
    auto newDepth =
        GlTexture::create(*device, kShadowSize, kShadowSize, GL_DEPTH_COMPONENT32F, "stage shadow depth");
    if (!newDepth)
        return newDepth.status();
    shadow = std::move(*newShadow);
    shadowDepth = std::move(*newDepth);
    return {};
}

StageBlock StageRenderer::Impl::makeBlock(const CameraView& camera, const StageLighting& lit, float exposure,
                                          int width, int height) const
{
    const Lighting& lighting = lit.lighting;
    const ViewBlock view = makeViewBlock(camera, width, height);
    StageBlock block{};
    block.clipFromWorld = camera.projection * camera.view;
    block.shadowFromMesh = sunClip(ball, lighting.sunDirection);
    block.rayDirection = {glm::vec3(view.rayDirection), 2.0f * ball.radius / float(kShadowSize)};
    block.rayDirectionX = view.rayDirectionX;
    block.rayDirectionY = view.rayDirectionY;
    block.sunDirection = {lighting.sunDirection, 1.0f / float(kShadowSize)};
    block.sunLight = {lighting.sunIlluminance * exposure,
                      float(std::min(lit.lights.size(), kMaxStageLights))};
    block.skyLight = {lighting.skyLuminance * exposure, lighting.groundAlbedo};
    const float kind = picture.name() == 0 ? 0.0f : (background.panorama ? 2.0f : 1.0f);
    block.meshOffset = {glm::vec3(meshOrigin - camera.origin), kind};
    block.background = {background.luminance * exposure, exposure};
    block.horizon = {background.horizon * exposure, isSoil ? 1.0f : 0.0f};
    const HillColors hills = hillColors(lighting, background.horizon);
    block.farHills = {hills.far * exposure, background.hasHills ? 1.0f : 0.0f};
    block.nearTrees = {hills.near * exposure,
                       2.0f * glm::length(glm::vec3(view.rayDirectionY)) /
                           (float(height) * std::max(glm::length(glm::vec3(view.rayDirection)), 1e-6f))};
    block.water = {float(solids), 0.0f, 0.0f, 0.0f};
    setLights(camera, lit, exposure, block);
    return block;
}

void StageRenderer::Impl::setLights(const CameraView& camera, const StageLighting& lit, float exposure,
                                    StageBlock& ioBlock) const
{
    if (lit.shadowTexture != 0)
        ioBlock.mediaShadows[0] = lit.sunShadow;
    size_t shadows = 1;
    for (size_t i = 0; i < std::min(lit.lights.size(), kMaxStageLights); ++i) {
        const StageLight& given = lit.lights[i];
        float index = -1.0f;
        if (given.shadow && lit.shadowTexture != 0 && shadows < kMaxStageShadows) {
            index = float(shadows);
            ioBlock.mediaShadows[shadows++] = *given.shadow;
        }
        ioBlock.lights[i] = {{glm::vec3(given.light.position - camera.origin), given.light.radius},
                             {given.light.intensity * exposure, 0.0f},
                             coneOf(given.light),
                             {given.wrap, index, 0.0f, 0.0f}};
    }
}

void StageRenderer::Impl::addShadowPass(ResourceId meshBuffer, const StageBlock& block)
{
    const ResourceId depthTarget = graph.importTexture(
        {"stage shadow depth", kShadowSize, kShadowSize, Format::R32F}, shadowDepth.name());
    const float farthest = 1.0f;
    device->gl.ClearTexImage(shadowDepth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
    graph.addPass("stage shadow", [&](FrameGraph::Builder& builder) {
        builder.read(meshBuffer);
        shadowMap = builder.write(shadowMap);
        const ResourceId depthVersion = builder.write(depthTarget);
        return
            [meshBuffer, uniforms = &block, target = shadowMap, depthVersion, count = casters](Backend& gpu) {
                gpu.clear(target, {1.0f, 1.0f, 1.0f, 1.0f});
                const BufferBinding buffers[] = {{0, meshBuffer}};
                DrawCall call;
                call.program = &kShadowProgram;
                call.targets = {&target, 1};
                call.buffers = buffers;
                call.uniforms = asUniforms(*uniforms);
                call.vertices = count;
                call.depthTarget = depthVersion;
                gpu.draw(call);
            };
    });
}

void StageRenderer::Impl::addPicturePass(ResourceId meshBuffer, const StageBlock& block,
                                         DepthConvention convention, uint32_t mediaShadows)
{
    const int width = color.width();
    const int height = color.height();
    ResourceId colorTarget =
        graph.importTexture({"stage color", width, height, Format::RGBA32F}, color.name());
    ResourceId depthTarget = graph.importTexture({"stage depth", width, height, Format::R32F}, depth.name());
    ResourceId sky;
    if (picture.name() != 0)
        sky = graph.importTexture({"background", picture.width(), picture.height(), Format::RGBA32F},
                                  picture.name());
    ResourceId planes;
    if (mediaShadows != 0)
        planes = graph.importTexture({"media shadows", 1, 1, Format::R32F}, mediaShadows);
    const bool reversed = convention == DepthConvention::Reversed;
    const float farthest = reversed ? 0.0f : 1.0f;
    device->gl.ClearTexImage(depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);

    graph.addPass("opaque scene", [&](FrameGraph::Builder& builder) {
        if (sky.valid())
            builder.read(sky);
        if (vertices > 0) {
            builder.read(meshBuffer);
            builder.read(shadowMap);
            if (planes.valid())
                builder.read(planes);
        }
        colorTarget = builder.write(colorTarget);
        depthTarget = builder.write(depthTarget);
        return [=, uniforms = &block, shadowTexture = shadowMap, count = vertices](Backend& gpu) {
            const TextureBinding skyBinding[] = {{0, sky, Sampling::Linear}};
            DrawCall call;
            call.program = &kBackgroundProgram;
            call.targets = {&colorTarget, 1};
            call.textures = {skyBinding, sky.valid() ? size_t(1) : size_t(0)};
            call.uniforms = asUniforms(*uniforms);
            gpu.draw(call);
            if (count == 0)
                return;
            const TextureBinding shadowBindings[] = {{0, shadowTexture}, {1, planes, Sampling::Linear}};
            const BufferBinding buffers[] = {{0, meshBuffer}};
            call.program = &kMeshProgram;
            call.textures = {shadowBindings, planes.valid() ? size_t(2) : size_t(1)};
            call.buffers = buffers;
            call.vertices = count;
            call.depthTarget = depthTarget;
            call.reversedDepth = reversed;
            gpu.draw(call);
        };
    });
    graph.keep(colorTarget);
    graph.keep(depthTarget);
}

base::Status StageRenderer::render(const CameraView& camera, const Lighting& lighting,
                                   std::span<const EffectLight> lights, float exposureEv100, int width,
                                   int height)
{
    std::array<StageLight, kMaxStageLights> given;
    const size_t count = std::min(lights.size(), given.size());
    for (size_t i = 0; i < count; ++i)
        given[i] = effectStageLight(lights[i]);
    StageLighting lit;
    lit.lighting = lighting;
    lit.lights = std::span(given).first(count);
    return render(camera, lit, exposureEv100, width, height);
}

base::Status StageRenderer::render(const CameraView& camera, const StageLighting& lit, float exposureEv100,
                                   int width, int height)
{
    const Lighting& lighting = lit.lighting;
    Impl& s = *impl_;
    if (base::Status status = s.prepareTargets(width, height); !status)
        return status;
    if (base::Status status = s.prepareShadow(); !status)
        return status;
    const StageBlock block = s.makeBlock(camera, lit, exposureFromEv100(exposureEv100), width, height);

    s.graph.begin();
    ResourceId meshBuffer;
    if (s.vertices > 0) {
        meshBuffer = s.graph.importBuffer({"stage mesh", s.mesh.bytes()}, s.mesh.name());
        s.shadowMap =
            s.graph.importTexture({"stage shadow", kShadowSize, kShadowSize, Format::R32F}, s.shadow.name());
        if (s.shadowDirection != lighting.sunDirection)
            s.addShadowPass(meshBuffer, block);
        s.shadowDirection = lighting.sunDirection;
    }
    s.addPicturePass(meshBuffer, block, camera.depth, lit.shadowTexture);
    s.graph.compile();

    GlStateGuard guard(*s.device);
    guard.touchAll();
    if (s.backend.beginFrame(s.graph))
        s.graph.execute(s.backend);
    return s.backend.endFrame();
}

} // namespace fx::render
