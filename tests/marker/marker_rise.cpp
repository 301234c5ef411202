// The accuracy entry of markers: the published height against rise times time in double precision.
#include "benchmarks/accuracy/accuracy_technique.h"
#include "tests/marker/marker_kind.h"
#include "tests/marker/marker_solver.h"

#include <cmath>

namespace fx::cli {
namespace {

class MarkerRise final : public AccuracyTechnique
{
public:
    std::string_view scene() const override { return "rise"; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t, const std::function<bool()>&) override
    {
        base::SnapshotSchema schema;
        schema.add(test::kMarkerKind);
        test::MarkerDef def;
        def.rise = 0.7f;
        const auto marker = def.create(schema, {}, std::pmr::get_default_resource());
        sim::StepCounters counters;
        sim::StepContext context{};
        context.stepTicks = base::toTicks(1.0 / 60.0);
        context.counters = &counters;
        std::vector<double> errors;
        for (int step = 0; step < 6000; ++step, context.tick += context.stepTicks) {
            marker->step(context);
            base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
            marker->publish({}, snapshot);
            const double expected = double(def.rise) * base::toSeconds(context.tick + context.stepTicks);
            errors.push_back(double(snapshot.group(0).column(1)[0]) / expected - 1.0);
        }
        AccuracySample sample;
        storeErrors(errors, sample);
        sample.items = double(errors.size());
        return sample;
    }

private:
    std::vector<AccuracySetting> settings_{{"float", "default", {}}};
};

} // namespace

AccuracyTechniqueEntry markerRiseAccuracy()
{
    return {"marker",
            "Heights of markers",
            "step",
            ShownError::P99,
            {"rise"},
            1,
            false,
            [](const std::string&, const AccuracyScale&) -> std::unique_ptr<AccuracyTechnique> {
                return std::make_unique<MarkerRise>();
            }};
}

} // namespace fx::cli
