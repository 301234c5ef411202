#include "rendering/compositions/volume/volume_network.h"

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

} // namespace

base::Status VolumeNetwork::makeRoom(std::span<const FieldGlowBlock> grids, int cells, const glm::dvec3& eye)
{
    grids_.assign(grids.begin(), grids.end());
    if (grids_.empty()) {
        known_.clear();
        return {};
    }
    if (cells != cells_ || volumes_.back().name() == 0 ||
        volumes_.front().depth() < cells * int(grids_.size())) {
        cells_ = cells;
        known_.clear();
        if (base::Status status = makeTextures(); !status)
            return status;
    }
    matchGrids(eye);
    settled_ = 0;
    return render::makeRoom(device_, buffer_, grids_.size() * sizeof(FieldGlowBlock), "network grids");
}

/// Light goes on in the grid whose middle is in the new one.
void VolumeNetwork::matchGrids(const glm::dvec3& eye)
{
    now_.clear();
    for (FieldGlowBlock& grid : grids_) {
        const Known own{glm::dvec3(grid.corner) + eye, grid.corner.w};
        now_.push_back(own);
        for (size_t i = 0; i < known_.size(); ++i) {
            const Known& other = known_[i];
            const glm::dvec3 middle = (other.corner - own.corner) / double(own.side) +
                                      0.5 * double(cells_) * double(other.side) / double(own.side);
            if (glm::any(glm::lessThan(middle, glm::dvec3(0.0))) ||
                glm::any(glm::greaterThan(middle, glm::dvec3(cells_))))
                continue;
            grid.before = glm::vec4(glm::vec3(other.corner - eye), other.side);
            grid.number.x = float(i);
            break;
        }
    }
    known_.swap(now_);
}

base::Status VolumeNetwork::makeTextures()
{
    const int layers = int(std::bit_ceil(grids_.size()));
    for (size_t i = 0; i < volumes_.size(); ++i) {
        volumes_[i] = {};
        auto created =
            GlTexture::createVolume(device_, kVolumes[i].across * cells_, kVolumes[i].up * cells_,
                                    layers * cells_, glInternalFormat(kVolumes[i].format), kVolumes[i].name);
        if (!created)
            return created.status();
        volumes_[i] = std::move(*created);
    }
    return {};
}

void VolumeNetwork::importAll(FrameGraph& graph)
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
}

void VolumeNetwork::addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, const LightBindings& lights,
                              bool isKept)
{
    if (grids_.empty())
        return;
    const bool prepares = !isKept || lights.hostShadow.valid();
    if (isKept && prepares)
        for (size_t i = 0; i < grids_.size(); ++i) { // they have not moved
            grids_[i].before = grids_[i].corner;
            grids_[i].number.x = float(i);
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
        in.cells = cells_;
        in.glow.cells = textures_.cells;
        in.glow.scatter = textures_.scatter;
        const GlowTextures sources = FieldGlowPass::addSourcesTo(graph, in);
        textures_.cells = sources.cells;
        textures_.scatter = sources.scatter;
    }
    const int sweeps = !prepares && isSettled() ? 0 : begins && prepares ? kSettledSweeps : kSweeps;
    settled_ += sweeps;
    textures_ = NetworkPasses::addTo(
                    graph, {gridsId_, textures_, lights, cells_, uint32_t(grids_.size()), sweeps, prepares})
                    .textures;
}

void VolumeNetwork::release()
{
    volumes_ = {};
    buffer_ = {};
    grids_.clear();
    known_.clear();
}

uint64_t VolumeNetwork::bytes() const
{
    uint64_t sum = buffer_.bytes();
    for (const GlTexture& volume : volumes_)
        sum += volume.name() != 0 ? volume.bytes() : 0;
    return sum;
}

} // namespace fx::render
