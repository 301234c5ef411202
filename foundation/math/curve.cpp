#include "foundation/math/curve.h"

namespace fx::base {

namespace {

template <size_t N>
std::array<float, N> evaluateKeys(std::span<const CurveKey<N>> keys, float t)
{
    if (t < keys.front().t)
        return keys.front().value;
    size_t i = keys.size() - 1;
    while (i > 0 && keys[i].t > t)
        --i;
    if (i + 1 == keys.size())
        return keys[i].value;
    const float f = (t - keys[i].t) / (keys[i + 1].t - keys[i].t); // keys[i].t <= t < keys[i + 1].t
    std::array<float, N> value;
    for (size_t k = 0; k < N; ++k)
        value[k] = keys[i].value[k] + f * (keys[i + 1].value[k] - keys[i].value[k]);
    return value;
}

} // namespace

template <size_t N>
Curve<N>::Curve(std::span<const CurveKey<N>> keys)
{
    for (size_t i = 0; i <= kCurveSamples; ++i)
        table_[i] = evaluateKeys(keys, float(i) / float(kCurveSamples));
}

template class Curve<1>;
template class Curve<3>;

} // namespace fx::base
