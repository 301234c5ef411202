#include "simulation/verification/air_blast.h"

#include <array>
#include <cmath>

namespace fx::sim {
namespace {

double square(double x)
{
    return x * x;
}

/// The time at which the line between two samples has the value.
double crossing(const PressureSample& a, const PressureSample& b, double value)
{
    return a.time + (b.time - a.time) * (value - a.overpressure) / (b.overpressure - a.overpressure);
}

/// Straight line through points, by least squares.
struct LineFit
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;

    void add(double px, double py)
    {
        n += 1;
        x += px;
        y += py;
        xx += px * px;
        xy += px * py;
    }
    double slope() const { return (n * xy - x * y) / (n * xx - x * x); }
    double intercept() const { return (y - slope() * x) / n; }
};

} // namespace

double kinneyGrahamOverpressure(double scaledDistance)
{
    const double z = scaledDistance;
    return kAirPressure * 808 * (1 + square(z / 4.5)) /
           std::sqrt((1 + square(z / 0.048)) * (1 + square(z / 0.32)) * (1 + square(z / 1.35))); // (1)
}

double kingeryBulmashOverpressure(double scaledDistance)
{
    constexpr std::array<double, 9> kCoefficients = {2.611368669,       -1.69012801396,    0.00804973591951,
                                                     0.336743114941,    -0.00516226351334, -0.0809228619888,
                                                     -0.00478507266747, 0.00793030472242,  0.0007684469735};
    const double u = -0.214362789151 + 1.35034249993 * std::log10(scaledDistance);
    double sum = 0;
    for (size_t k = kCoefficients.size(); k-- > 0;)
        sum = sum * u + kCoefficients[k]; // (2)
    return 1000 * std::pow(10.0, sum);
}

double FriedlanderWave::at(double time) const
{
    const double x = (time - arrival) / duration;
    return x < 0 ? 0 : peak * (1 - x) * std::exp(-decay * x); // (3)
}

FriedlanderWave fitFriedlander(std::span<const PressureSample> samples)
{
    size_t top = 0;
    for (size_t i = 1; i < samples.size(); ++i)
        top = samples[i].overpressure > samples[top].overpressure ? i : top;
    size_t rise = top;
    while (rise > 0 && samples[rise - 1].overpressure > 0.5 * samples[top].overpressure)
        --rise;
    size_t end = top;
    while (end < samples.size() && samples[end].overpressure > 0)
        ++end;
    if (rise == 0 || rise > top || end == samples.size() || end == top)
        return {};

    FriedlanderWave wave;
    wave.arrival = crossing(samples[rise - 1], samples[rise], 0.5 * samples[top].overpressure);
    wave.duration = crossing(samples[end - 1], samples[end], 0.0) - wave.arrival;
    // The front is smeared over as much behind the top as in front of it.
    const double from = 2 * samples[top].time - wave.arrival;
    LineFit line;
    for (size_t i = top; i < end; ++i) {
        const double x = (samples[i].time - wave.arrival) / wave.duration;
        if (samples[i].time >= from && x < 0.8)
            line.add(x, std::log(samples[i].overpressure / (1 - x)));
    }
    if (line.n < 3)
        return {};
    wave.peak = std::exp(line.intercept());
    wave.decay = -line.slope();
    return wave;
}

} // namespace fx::sim
