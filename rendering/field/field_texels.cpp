#include "rendering/field/field_texels.h"

#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <iterator>

namespace fx::render {

constexpr ProgramDesc kFieldTexelProgram{"field texels", nullptr, nullptr, "field/field_texels.comp.glsl",
                                         nullptr};

int rowsOfTexels(size_t count, int columns)
{
    return int(std::bit_ceil((std::max<size_t>(count, 1) + size_t(columns) - 1) / size_t(columns)));
}

/// Balls of one field come one after the other.
void FieldTexels::addNear(const FieldPlan& plan, std::span<const FieldDetailBlock> details,
                          const FieldBalls& balls)
{
    const size_t firstDetail = sizeof(FieldBlock) / sizeof(glm::vec4) * plan.fields().size();
    for (const NearBall& ball : plan.near().balls()) {
        if (ball.detail < 0)
            continue;
        const BlobInstance& blob = balls.blobs[ball.number];
        const BlobMaterial& material = balls.materials[ball.number];
        const glm::vec4& erosion = details[size_t(ball.detail)].erosion;
        const float held = std::max(blob.centerRadius.w, plan.fields()[ball.field].limits.x);
        const float depth = formula::fxKernelPeak(blob.medium.x, held) * erosion.x;
        const float thinning = formula::fxDetailThinning(depth, erosion.y, erosion.z);
        glm::vec4& soft = texels_[firstDetail + kDetailTexels * (size_t(ball.detail) + 1) - 1];
        soft.y = soft.z > 0.0f ? soft.y : float(texels_.size());
        soft.z += 1.0f;
        soft.w = std::max(soft.w, glm::length(glm::vec3(blob.centerRadius)) + blob.centerRadius.w);
        const glm::vec4 texels[] = {blob.centerRadius,
                                    {glm::vec3(blob.emission), ball.share * blob.medium.x},
                                    {glm::vec3(material.carried[0]), thinning},
                                    {glm::vec3(material.carried[1]), blob.emission.w}};
        static_assert(std::size(texels) == kNearTexels);
        texels_.insert(texels_.end(), std::begin(texels), std::end(texels));
    }
}

void FieldTexels::build(const FieldPlan& plan, std::span<const FieldDetailBlock> details,
                        const FieldBalls& balls)
{
    const size_t firstDetail = sizeof(FieldBlock) / sizeof(glm::vec4) * plan.fields().size();
    texels_.clear();
    for (const FieldBlock& field : plan.fields()) {
        glm::vec4 limits = field.limits;
        limits.z = limits.z > 0.5f ? float(firstDetail + kDetailTexels * (size_t(limits.z) - 1)) : 0.0f;
        texels_.insert(texels_.end(), {field.corner, glm::vec4(field.bricks), limits});
    }
    for (const FieldDetailBlock& detail : details) {
        texels_.insert(texels_.end(), std::begin(detail.rows), std::end(detail.rows));
        texels_.insert(texels_.end(), {detail.erosion, detail.noise, detail.lumps, detail.soft});
    }
    addNear(plan, details, balls);
    tiles_.assign(plan.tiles().begin(), plan.tiles().end());
    for (FieldTileBlock& tile : tiles_)
        tile.first += uint32_t(texels_.size());
    for (const uint32_t field : plan.tileFields())
        texels_.push_back({float(field), 0.0f, 0.0f, 0.0f});
}

ResourceId FieldTexelPass::addTo(FrameGraph& graph, ResourceId list, size_t count, ResourceId texture)
{
    ResourceId written;
    graph.addPass("field texels", [&](FrameGraph::Builder& builder) {
        builder.read(list);
        written = builder.write(texture.valid()
                                    ? texture
                                    : builder.create({"texels of a list", kFieldColumns,
                                                      rowsOfTexels(count, kFieldColumns), Format::RGBA32F}));
        return [list, count, written](Backend& backend) {
            const BufferBinding buffers[] = {{0, list}};
            const ImageBinding images[] = {{0, written}};
            const glm::ivec4 counts(int(count), 0, 0, 0);
            DispatchCall call;
            call.program = &kFieldTexelProgram;
            call.buffers = buffers;
            call.images = images;
            call.uniforms = asUniforms(counts);
            call.groups[0] = uint32_t((count + 63) / 64);
            backend.dispatch(call);
        };
    });
    return written;
}

} // namespace fx::render
