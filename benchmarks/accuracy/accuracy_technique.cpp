#include "benchmarks/accuracy/accuracy_technique.h"

#include "fxsdk/cli/support/interrupt.h"

namespace fx::cli {

base::Result<AccuracySample> CountedAccuracy::run(size_t setting, const std::function<bool()>& stop)
{
    if (stop())
        return interruptedStatus();
    const MeasuredWork measured = *work(setting);
    AccuracySample sample;
    sample.seconds = measured.seconds;
    sample.instructions = measured.instructions;
    sample.items = items();
    judge(setting, sample);
    return sample;
}

} // namespace fx::cli
