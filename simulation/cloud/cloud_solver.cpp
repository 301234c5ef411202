#include "simulation/cloud/cloud_solver.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

class CloudSolver final : public StillMediumSolver
{
public:
    CloudSolver(const CloudDef& def, base::KindId kind) : def_(def), kind_(kind) {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kind_ == base::kNoKind)
            return;
        const uint32_t count = elementCount();
        BlobWriter writer(snapshot, base, kind_, count, count);
        writeShared(def_, writer);
        const float amount = def_.sectionScale();
        for (uint32_t i = 0; i < count; ++i) {
            const ListedBall& ball = (*def_.balls)[i];
            for (int k = 0; k < 3; ++k) {
                writer.column(blob::PositionX + size_t(k))[i] =
                    def_.position[k] + def_.scale * ball.center[k];
                writer.column(blob::AlbedoR + size_t(k))[i] = ball.albedo[k];
                writer.column(blob::EmissionR + size_t(k))[i] = ball.emission[k];
            }
            writer.column(blob::Radius)[i] = def_.scale * ball.radius;
            writer.column(blob::CrossSection)[i] = amount * ball.crossSection;
            writer.column(blob::Temperature)[i] = ball.temperature;
            writer.ids()[i] = blobId(base.solver, i);
        }
        writer.closeBounds();
    }

    uint32_t elementCount() const override { return def_.capacity(); }

private:
    const CloudDef& def_;
    base::KindId kind_;
};

} // namespace

std::unique_ptr<Solver> CloudDef::create(const base::SnapshotSchema& schema, const Quality&,
                                         std::pmr::memory_resource*) const
{
    return std::make_unique<CloudSolver>(*this, schema.find(base::kBlobKind.name));
}

float CloudDef::reach(float, float, float) const
{
    float farthest = 0.0f;
    if (balls)
        for (const ListedBall& ball : *balls)
            farthest = std::max(farthest, glm::length(position + scale * ball.center) + scale * ball.radius);
    return farthest * 1.0001f; // above rounding
}

} // namespace fx::sim
