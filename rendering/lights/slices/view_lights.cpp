#include "rendering/lights/slices/view_lights.h"

#include "foundation/math/hash.h"
#include "foundation/memory/amortized_vector.h"
#include "rendering/lights/slices/light_slices_pass.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace fx::render {

namespace {

/// Of as many stacks as there may be, since their number changes while planes fade.
constexpr size_t kStackBytes = std::bit_ceil((kMaxLightEntries + kFadingEntries) * sizeof(SliceStackBlock));

constexpr int kTallestSpare = 8192; ///< [texel] of an atlas that is higher than it has to be

/// Of what planes hold.
uint64_t keyOf(uint64_t casterRevision, const LightListInputs& in, const LightList& list)
{
    return base::hashWord(base::hashWord(casterRevision, in.casters.size()), list.placesRevision()) | 1;
}

} // namespace

std::span<const ProgramDesc* const> lightPrograms()
{
    static constexpr const ProgramDesc* kPrograms[] = {&kLightSlicesProgram};
    return kPrograms;
}

ViewLights::ViewLights(GlDevice* device, std::pmr::memory_resource* memory)
    : device_(*device), list_(memory), casters_(memory), held_(memory), shifted_(memory)
{}

/// Whether planes need not follow what has moved in this frame.
bool ViewLights::mayWait(const LightListInputs& in)
{
    return ++age_ < in.settings->slices.refreshFrames && filled_ != 0 && !held_.empty() &&
           !in.casters.empty();
}

/// Lists the lights with the planes as they are filled.  @return false: they have to be filled again
bool ViewLights::buildBehind(const LightListInputs& in)
{
    shifted_ = held_;
    for (MediumCaster& caster : shifted_)
        caster.center += glm::vec3(heldEye_ - in.eye);
    LightListInputs held = in;
    held.casters = shifted_;
    if (in.isOtherEye)
        list_.rebuild(held);
    else
        list_.build(held);
    return keyOf(heldRevision_, held, list_) == filled_;
}

void ViewLights::hold(const LightListInputs& in, uint64_t revision)
{
    held_.clear();
    if (in.settings->slices.refreshFrames > 1)
        base::assignAmortized(held_, in.casters);
    heldEye_ = in.eye;
    heldRevision_ = revision;
    age_ = 0;
}

base::Status ViewLights::gather(const LightListInputs& in, uint64_t casters, bool isUsed)
{
    isKept_ = false;
    eye_ = in.eye;
    const bool areMoving = casters != std::exchange(givenRevision_, casters);
    const bool waits = in.isOtherEye ? isBehind_ : areMoving && heldRevision_ != casters && mayWait(in);
    isBehind_ = waits && buildBehind(in);
    if (isBehind_)
        return isUsed ? makeRoom() : base::Status();
    if (waits || in.isOtherEye)
        list_.rebuild(in);
    else
        list_.build(in);
    wanted_ = keyOf(casters, in, list_);
    if (wanted_ != filled_) {
        hold(in, casters);
        casters_.clear();
        for (const MediumCaster& caster : in.casters)
            casters_.push_back(
                {glm::vec4(caster.center, caster.radius), glm::vec4(caster.crossSection, 0.0f, 0.0f, 0.0f)});
    }
    return isUsed ? makeRoom() : base::Status();
}

base::Status ViewLights::makeRoom()
{
    if (lightBuffer_.bytes() == 0) {
        auto created = GlBuffer::create(device_, sizeof(LightListBlock), "lights");
        if (!created)
            return created.status();
        lightBuffer_ = std::move(*created);
    }
    if (list_.stacks().empty())
        return {};
    const int width = std::max(atlas_.width(), list_.atlasWidth());
    int height = std::max(atlas_.height(), list_.atlasHeight());
    if (atlas_.height() > 0 && height > atlas_.height()) // planes that fade come and go: grow seldom
        height = std::max(height, std::min(2 * atlas_.height(), kTallestSpare));
    if (width == atlas_.width() && height == atlas_.height())
        return {};
    atlas_ = {};
    auto created = GlTexture::create(device_, width, height, glInternalFormat(Format::RG32F), "light slices");
    if (!created)
        return created.status();
    atlas_ = std::move(*created);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) // hosts sample it as it is
        device_.gl.TextureParameteri(atlas_.name(), filter, GL_LINEAR);
    filled_ = 0;
    return {};
}

MediaShadowBlock ViewLights::shadow(LightKind kind, uint32_t index, const glm::dvec3& origin) const
{
    const std::span<const LightOrigin> origins = list_.origins();
    for (size_t i = 0; i < origins.size() && isFilled(); ++i)
        if (origins[i].kind == kind && origins[i].index == index)
            return mediaShadow(list_, i, eye_, origin);
    return {};
}

void ViewLights::setSunShadow(const HostShadowMap& map, const glm::dvec3& origin)
{
    sunShadow_ = map.texture;
    if (list_.setSunShadow(map, eye_ - origin))
        isKept_ = false; // the list goes to the GPU again, the planes stay
}

LightBindings ViewLights::addPasses(FrameGraph& graph)
{
    LightBindings bindings;
    if (lightBuffer_.bytes() == 0)
        return bindings;
    bindings.lights = graph.importBuffer({"lights", sizeof(LightListBlock)}, lightBuffer_.name());
    if (sunShadow_ != 0)
        bindings.hostShadow = graph.importTexture({"host shadow map", 1, 1, Format::R32F}, sunShadow_);
    if (!isKept_)
        graph.addPass("light list", [&](FrameGraph::Builder& builder) {
            bindings.lights = builder.write(bindings.lights);
            return [buffer = bindings.lights, block = &list_.block()](Backend& backend) {
                backend.upload(buffer, asUniforms(*block));
            };
        });
    if (!list_.stacks().empty() && atlas_.name() != 0)
        bindings.planes = graph.importTexture(
            {"light slices", atlas_.width(), atlas_.height(), Format::RG32F}, atlas_.name());
    bindings.stacks = std::as_bytes(list_.stackBlocks());
    bindings.mostTexels = list_.mostTexels();
    bindings.filled = wanted_;
    if (!bindings.planes.valid() || filled_ == wanted_)
        return bindings;
    ResourceId casters, stacks;
    graph.addPass("light slice casters", [&](FrameGraph::Builder& builder) {
        const std::span<const CasterBlock> casterBlocks = casters_;
        const std::span<const SliceStackBlock> stackBlocks = list_.stackBlocks();
        casters = builder.write(
            builder.create(BufferDesc{"light casters", std::bit_ceil(casterBlocks.size_bytes())}));
        stacks = builder.write(builder.create(BufferDesc{"light stacks", kStackBytes}));
        return [casters, stacks, casterBlocks, stackBlocks](Backend& backend) {
            backend.upload(casters, std::as_bytes(casterBlocks));
            backend.upload(stacks, std::as_bytes(stackBlocks));
        };
    });
    bindings.planes =
        LightSlicesPass::addTo(graph,
                               {casters, stacks, bindings.planes, uint32_t(casters_.size()),
                                uint32_t(list_.stackBlocks().size()), list_.mostTexels(), list_.mostPlanes()})
            .atlas;
    graph.keep(bindings.planes); // later frames read it
    filled_ = wanted_;
    return bindings;
}

void ViewLights::forget()
{
    filled_ = 0;
}

void ViewLights::release()
{
    lightBuffer_ = {};
    atlas_ = {};
    filled_ = 0;
}

uint64_t ViewLights::bytes() const
{
    return lightBuffer_.bytes() + atlas_.bytes();
}

} // namespace fx::render
