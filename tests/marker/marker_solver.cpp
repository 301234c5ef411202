#include "tests/marker/marker_solver.h"

#include "tests/marker/marker_kind.h"

#include <algorithm>

namespace fx::test {

namespace {

class MarkerSolver final : public sim::Solver
{
public:
    MarkerSolver(const MarkerDef& def, base::KindId kind) : def_(def), kind_(kind) {}

    void step(const sim::StepContext& context) override
    {
        now_ = context.tick + context.stepTicks;
        context.counters->particleSteps += 1;
    }

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kind_ == base::kNoKind)
            return;
        base::SnapshotGroup& group = snapshot.addGroup(kind_, 1);
        group.editInfo() = base;
        group.editInfo().kind = kind_;
        group.editInfo().count = 1;
        for (size_t a = 0; a < 3; ++a)
            group.editColumn(a)[0] = def_.position[int(a)];
        group.editColumn(1)[0] += def_.rise * float(base::toSeconds(now_));
        const float constants[] = {0.5f * def_.side, def_.luminance.x, def_.luminance.y, def_.luminance.z};
        std::ranges::copy(constants, group.editConstants().begin());
    }

    bool finished(base::Ticks) const override { return false; }
    uint32_t elementCount() const override { return 1; }
    void save(sim::StateWriter& writer) const override { writer.value(now_); }
    void restore(sim::StateReader& reader) override { now_ = reader.value<base::Ticks>(); }

private:
    const MarkerDef& def_;
    base::KindId kind_;
    base::Ticks now_ = 0; ///< end of the last step
};

} // namespace

std::unique_ptr<sim::Solver> MarkerDef::create(const base::SnapshotSchema& schema, const sim::Quality&,
                                               std::pmr::memory_resource*) const
{
    return std::make_unique<MarkerSolver>(*this, schema.find(kMarkerKind.name));
}

bool MarkerDef::publishes(const base::KindDesc& kind) const
{
    return kind == kMarkerKind;
}

} // namespace fx::test
