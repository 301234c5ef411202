#include "benchmarks/accuracy/accuracy_errors.h"

#include "foundation/math/bits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::cli {

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
