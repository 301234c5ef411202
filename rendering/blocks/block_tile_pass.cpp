#include "rendering/blocks/block_tile_pass.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::render {

namespace {

constexpr int kGroupTexels = 8; ///< along a side of a workgroup

} // namespace

void BlockTileJobs::begin()
{
    jobs_.clear();
    balls_.clear();
}

void BlockTileJobs::add(std::span<const TileJob> jobs, const BlockContents& contents)
{
    std::array<uint32_t, base::kMaxBlockVariants> first;
    first.fill(UINT32_MAX);
    for (const TileJob& job : jobs) {
        const BlockContent& content = contents.of(job.variant);
        uint32_t& begin = first[job.variant];
        if (begin == UINT32_MAX) {
            begin = uint32_t(balls_.size());
            contents.balls(job.variant, balls_);
        }
        const float brightest = std::max({content.brightest.x, content.brightest.y, content.brightest.z});
        jobs_.push_back(
            {{job.corner, int(begin), int(content.balls)},
             {job.axes.right, job.radius / std::sqrt(1.0f - job.nearness * job.nearness)},
             {job.axes.up, float(job.size)},
             {brightest > 0.0f ? 1.0f / brightest : 0.0f, content.isColored ? 1.0f : 0.0f, job.density, 0.0f},
             {job.nearness / job.radius, job.radius, 0.0f, 0.0f}});
    }
}

ResourceId BlockTileJobs::addTo(FrameGraph& graph, ResourceId atlas, int rows)
{
    std::ranges::stable_sort(jobs_, {}, [](const Job& job) { return job.up.w; });
    ResourceId jobs, balls, written = atlas;
    graph.addPass("block tile upload", [&](FrameGraph::Builder& builder) {
        const auto buffer = [&](const char* name, size_t bytes) {
            return builder.write(
                builder.create(BufferDesc{name, std::bit_ceil(std::max<size_t>(bytes, 64))}));
        };
        jobs = buffer("block tile jobs", jobs_.size() * sizeof(Job));
        balls = buffer("balls of blocks", balls_.size() * sizeof(BlockBall));
        return [jobs, balls, this](Backend& backend) {
            backend.upload(jobs, std::as_bytes(std::span(jobs_)));
            backend.upload(balls, std::as_bytes(std::span(balls_)));
        };
    });
    graph.addPass("block tiles", [&](FrameGraph::Builder& builder) {
        builder.read(jobs);
        builder.read(balls);
        written = builder.write(atlas);
        return [jobs, balls, written, rows, this](Backend& backend) {
            const BufferBinding buffers[] = {{0, jobs}, {1, balls}};
            const ImageBinding images[] = {{0, written}};
            for (size_t begin = 0; begin < jobs_.size();) {
                size_t end = begin;
                while (end < jobs_.size() && jobs_[end].up.w == jobs_[begin].up.w)
                    ++end;
                const glm::ivec4 block(int(begin), rows * kMaxTile, 0, 0);
                DispatchCall call;
                call.program = &kBlockTilesProgram;
                call.buffers = buffers;
                call.images = images;
                call.uniforms = asUniforms(block);
                call.groups[0] = call.groups[1] = uint32_t(jobs_[begin].up.w) / kGroupTexels;
                call.groups[2] = uint32_t(end - begin);
                backend.dispatch(call);
                begin = end;
            }
        };
    });
    return written;
}

} // namespace fx::render
