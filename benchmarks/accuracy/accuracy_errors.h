/// @file accuracy_errors.h
/// The distribution of many relative errors as the numbers of a report.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <vector>

namespace fx::cli {

/// Mean, quantiles and largest of |error|, bias of the signed ones. A value that is not finite counts as an
/// infinite error. Nothing is stored for an empty list.
void storeErrors(std::vector<double> errors, AccuracySample& outSample);

} // namespace fx::cli
