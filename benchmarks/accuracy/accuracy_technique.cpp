#include "benchmarks/accuracy/accuracy_technique.h"

#include "foundation/math/bits.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void storeErrors(std::vector<double> errors, AccuracySample& outSample)
{
    if (errors.empty())
        return;
    double sum = 0;
    double absolute = 0;
    for (double& error : errors) {
        if (!base::isFinite(error))
            error = std::numeric_limits<double>::infinity();
        sum += error;
        error = std::abs(error);
        absolute += error;
    }
    std::sort(errors.begin(), errors.end());
    const double count = double(errors.size());
    outSample.errorMean = absolute / count;
    outSample.bias = sum / count;
    outSample.errorP50 = errors[errors.size() / 2];
    outSample.errorP99 = errors[std::min(errors.size() - 1, errors.size() * 99 / 100)];
    outSample.errorMax = errors.back();
}

} // namespace fx::cli
