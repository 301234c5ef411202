/// @file schema_validator.h
/// Validates documents against a JSON Schema with valijson and explains violations.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace fx::preset {

class SchemaValidator
{
public:
    /// Creates a validator.
    /// @param schema a schema from schema_assembly.h
    explicit SchemaValidator(nlohmann::json schema);
    ~SchemaValidator();
    SchemaValidator(const SchemaValidator&) = delete;
    SchemaValidator& operator=(const SchemaValidator&) = delete;

    /// Adds an error to `findings` for each violation of the schema in `document`, until `findings` is full.
    /// @param longArrays pointers to array members whose elements are checked one by one, to limit the
    ///     memory for findings
    /// @param document the document; it is modified temporarily, and restored before the return
    void validate(nlohmann::json& document, std::span<const std::string_view> longArrays,
                  Findings& findings) const;

private:
    struct Part;
    void validatePart(const Part& part, const nlohmann::json& value, const std::string& pointer,
                      Findings& findings) const;

    std::unique_ptr<Part> root_;
};

} // namespace fx::preset
