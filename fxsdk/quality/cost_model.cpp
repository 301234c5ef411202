#include "fxsdk/quality/cost_model.h"

#include "foundation/math/bits.h"

#include <algorithm>

namespace fx::quality {

void CostModel::observe(size_t technique, double cost, double milliseconds)
{
    if (!base::isFinite(milliseconds) || milliseconds < 0.0)
        return;
    Estimate& e = estimates_[technique];
    if (!(cost > 0.0)) {
        e.scale -= kForget * e.scale;
        return;
    }
    const double seen = milliseconds / cost;
    if (!e.known) {
        e.scale = seen;
        e.known = true;
        return;
    }
    const bool isSlow = seen > kJump * e.scale;
    const double least = std::min({seen, e.before[0], e.before[1]}); // 0 unless all three were slow
    if (isSlow && least > 0.0)
        e.scale = std::max(e.scale, least); // three in a row: the load has changed
    else
        e.scale += kFollow * (std::min(seen, kJump * e.scale) - e.scale);
    e.before = {isSlow ? seen : 0.0, e.before[0]};
}

} // namespace fx::quality
