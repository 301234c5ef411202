#include "foundation/snapshot/snapshot_schema.h"

#include <stdexcept>

namespace fx::base {

KindId SnapshotSchema::add(const KindDesc& kind)
{
    const KindId known = find(kind.name);
    if (known != kNoKind)
        return known;
    if (kind.columns.size() > kMaxColumns || kind.constants.size() > kMaxConstants)
        throw std::length_error("a kind of the snapshot has too many columns or constants");
    kinds_.push_back(kind);
    return KindId(kinds_.size() - 1);
}

KindId SnapshotSchema::find(std::string_view name) const
{
    for (size_t i = 0; i < kinds_.size(); ++i)
        if (kinds_[i].name == name)
            return KindId(i);
    return kNoKind;
}

} // namespace fx::base
