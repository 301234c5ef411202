/// @file snapshots.h
/// Two states of a document, A and B, to switch between.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/document/text_difference.h"

#include <array>
#include <optional>
#include <vector>

namespace fx::editor {

class Snapshots
{
public:
    static constexpr size_t kSlots = 2; ///< A and B

    /// Keeps the present state of the document.
    void take(size_t slot, const Document& document) { slots_.at(slot) = document.json(); }
    bool has(size_t slot) const { return slots_.at(slot).has_value(); }
    const Json* state(size_t slot) const { return has(slot) ? &*slots_.at(slot) : nullptr; }

    /// Restores a state, as one edit that can be undone. @return false if the slot is empty
    bool restore(size_t slot, Document& io) const
    {
        if (!has(slot))
            return false;
        io.replace(*slots_.at(slot), slot == 0 ? "restore A" : "restore B");
        return true;
    }

    /// Lines by which the present document differs from a state; empty if the slot is empty.
    std::vector<DifferenceLine> differenceFrom(size_t slot, const Document& document) const
    {
        if (!has(slot))
            return {};
        return difference(writeJson(*slots_.at(slot), document.json(), document.text()), document.text());
    }

private:
    std::array<std::optional<Json>, kSlots> slots_;
};

} // namespace fx::editor
