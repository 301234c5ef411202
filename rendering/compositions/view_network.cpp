#include "rendering/compositions/view_network.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

struct Volume
{
    const char* name;
    Format format;
    int across, up; ///< blocks
};

constexpr Volume kVolumes[] = {{"network cells", Format::RGBA32F, 1, 1},
                               {"network scatter", Format::RGBA16F, 1, 1},
                               {"network medium", Format::RGBA32F, kNetworkMedium, 1},
                               {"network unswept", Format::RGBA32F, kNetworkMoments, 1},
                               {"network sources", Format::RGBA32F, kNetworkMoments, 1},
                               {"network moments", Format::RGBA32F, kNetworkMoments, 1},
                               {"network rays", Format::RGBA32F, kNetworkRays[0], kNetworkRays[1]}};

constexpr size_t kMoments = 5; ///< index of the texture of moments

constexpr int64_t kMostSpare = 4; ///< most texels of a block, in units of those that grids take

} // namespace

base::Status ViewNetwork::makeRoom(std::span<const FieldGlowBlock> grids, const glm::dvec3& eye)
{
    outgrown_ = {};
    grids_.assign(grids.begin(), grids.end());
    if (grids_.empty()) {
        known_.clear();
        return {};
    }
    if (base::Status status = makeTextures(glowExtent(grids_)); !status) {
        known_.clear();
        return status;
    }
    matchGrids(eye);
    settled_ = 0;
    return render::makeRoom(device_, buffer_, grids_.size() * sizeof(FieldGlowBlock), "network grids");
}

/// Light goes on in the grid whose middle is in the new one.
void ViewNetwork::matchGrids(const glm::dvec3& eye)
{
    now_.clear();
    for (FieldGlowBlock& grid : grids_) {
        const Known own{glm::dvec3(grid.corner) + eye, grid.corner.w, grid.cells};
        now_.push_back(own);
        for (size_t i = 0; i < known_.size(); ++i) {
            const Known& other = known_[i];
            const glm::dvec3 middle = (other.corner - own.corner) / double(own.side) +
                                      0.5 * double(other.side) / double(own.side) * glm::dvec3(other.cells);
            if (glm::any(glm::lessThan(middle, glm::dvec3(0.0))) ||
                glm::any(glm::greaterThan(middle, glm::dvec3(own.cells))))
                continue;
            grid.before = glm::vec4(glm::vec3(other.corner - eye), other.side);
            grid.cellsBefore = other.cells;
            break;
        }
    }
    known_.swap(now_);
}

/// Blocks do not shrink while grids take a quarter of them, so that a grid that grows and shrinks does not
/// create textures in each frame.
base::Status ViewNetwork::makeTextures(const glm::ivec3& extent)
{
    const glm::ivec3 wide = glm::max(block_, extent);
    const auto texels = [](const glm::ivec3& size) { return int64_t(size.x) * size.y * size.z; };
    const glm::ivec3 wanted = texels(wide) > kMostSpare * texels(extent) ? extent : wide;
    if (wanted == block_)
        return {};
    if (!known_.empty())
        outgrown_ = std::move(volumes_[kMoments]);
    block_ = {};
    for (size_t i = 0; i < volumes_.size(); ++i) {
        volumes_[i] = {};
        auto created =
            GlTexture::createVolume(device_, kVolumes[i].across * wanted.x, kVolumes[i].up * wanted.y,
                                    wanted.z, glInternalFormat(kVolumes[i].format), kVolumes[i].name);
        if (!created)
            return created.status();
        volumes_[i] = std::move(*created);
    }
    block_ = wanted;
    return {};
}

void ViewNetwork::importAll(FrameGraph& graph)
{
    textures_ = {};
    gridsId_ = {};
    if (grids_.empty())
        return;
    gridsId_ = graph.importBuffer({"network grids", std::bit_ceil(grids_.size() * sizeof(FieldGlowBlock))},
                                  buffer_.name());
    ResourceId* const ids[] = {&textures_.cells,   &textures_.scatter, &textures_.medium, &textures_.unswept,
                               &textures_.sources, &textures_.moments, &textures_.rays};
    for (size_t i = 0; i < volumes_.size(); ++i)
        *ids[i] = graph.importTexture(
            {kVolumes[i].name, volumes_[i].width(), volumes_[i].height(), kVolumes[i].format},
            volumes_[i].name());
    textures_.before = outgrown_.name() == 0
                           ? textures_.moments
                           : graph.importTexture({"network moments before", outgrown_.width(),
                                                  outgrown_.height(), kVolumes[kMoments].format},
                                                 outgrown_.name());
}

void ViewNetwork::addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, const LightBindings& lights,
                            bool isKept)
{
    if (grids_.empty())
        return;
    const bool prepares = !isKept || lights.hostShadow.valid();
    if (isKept && prepares) {
        for (FieldGlowBlock& grid : grids_) { // they have not moved
            grid.before = grid.corner;
            grid.cellsBefore = grid.cells;
        }
        textures_.before = textures_.moments;
    }
    const bool begins = std::ranges::any_of(grids_, [](const auto& grid) { return grid.before.w == 0.0f; });
    if (prepares) {
        graph.addPass("network upload", [&](FrameGraph::Builder& builder) {
            gridsId_ = builder.write(gridsId_);
            return [buffer = gridsId_, grids = std::span<const FieldGlowBlock>(grids_)](Backend& backend) {
                backend.upload(buffer, std::as_bytes(grids));
            };
        });
        in.grids = gridsId_;
        in.gridCount = uint32_t(grids_.size());
        in.extent = glowExtent(grids_);
        in.glow.cells = textures_.cells;
        in.glow.scatter = textures_.scatter;
        const GlowTextures sources = FieldGlowPass::addSourcesTo(graph, in);
        textures_.cells = sources.cells;
        textures_.scatter = sources.scatter;
    }
    const int sweeps = !prepares && isSettled() ? 0 : begins && prepares ? kSettledSweeps : kSweeps;
    settled_ += sweeps;
    textures_ =
        NetworkPasses::addTo(graph, {gridsId_, textures_, lights, block_, glowExtent(grids_),
                                     mostNetworkLines(grids_), uint32_t(grids_.size()), sweeps, prepares})
            .textures;
}

void ViewNetwork::release()
{
    volumes_ = {};
    outgrown_ = {};
    block_ = {};
    buffer_ = {};
    grids_.clear();
    known_.clear();
}

uint64_t ViewNetwork::bytes() const
{
    uint64_t sum = buffer_.bytes() + outgrown_.bytes();
    for (const GlTexture& volume : volumes_)
        sum += volume.bytes();
    return sum;
}

} // namespace fx::render
