#include "simulation/verification/shear_layer.h"

#include <cmath>
#include <complex>

namespace fx::sim {

double ShearLayer::incompressibleGrowth() const
{
    return wavenumber * std::abs(speed1 - speed2) * std::sqrt(density1 * density2) /
           (density1 + density2); // (3)
}

double ShearLayer::growth() const
{
    using Complex = std::complex<double>;
    const auto side = [this](Complex w, double density, double speed, double sound) {
        const Complex seen = w - wavenumber * speed;
        const Complex q = std::sqrt(wavenumber * wavenumber - seen * seen / (sound * sound)); // (1)
        return density * seen * seen / q;
    };
    const auto mismatch = [&](Complex w) {
        return side(w, density1, speed1, sound1) + side(w, density2, speed2, sound2); // (2)
    };
    const double drift = wavenumber * (density1 * speed1 + density2 * speed2) / (density1 + density2);
    Complex w(drift, incompressibleGrowth());
    for (int i = 0; i < 50; ++i) {
        const double step = 1e-6 * std::abs(w);
        const Complex slope = (mismatch(w + step) - mismatch(w - step)) / (2 * step);
        w -= mismatch(w) / slope;
    }
    return w.imag();
}

} // namespace fx::sim
