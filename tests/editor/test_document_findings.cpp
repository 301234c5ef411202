#include "fxsdk/editor/document/document_findings.h"

#include "fxsdk/presets/preset_loader.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

Document documentOf(const std::string& text)
{
    auto document = Document::fromText(text, "a.fx.json");
    EXPECT_TRUE(document.ok());
    return std::move(*document);
}

/// Applies the remedies of all findings until none is left or ten rounds have passed.
size_t findingsAfterRemedies(Document& io)
{
    for (int round = 0; round < 10; ++round) {
        const auto findings = findingsOf(io);
        const auto found = std::find_if(findings.begin(), findings.end(), [](const DocumentFinding& finding) {
            return finding.remedy.has_value();
        });
        if (found == findings.end())
            return findings.size();
        EXPECT_TRUE(applyRemedy(io, *found->remedy).ok());
    }
    return ~size_t(0);
}

TEST(DocumentFindings, aNumberOutOfItsRangeIsSetToTheBound)
{
    Document document = documentOf(
        R"({"version": 1, "emitters": [{"emission": {"rate": 5}, "speed": -5000, "radius": 9000}]})");
    EXPECT_EQ(findingsAfterRemedies(document), 0u);
    EXPECT_EQ(document.json()["emitters"][0]["speed"], -1000);
    EXPECT_EQ(document.json()["emitters"][0]["radius"], 1000);
}

TEST(DocumentFindings, aMisspelledChoiceIsSetToTheNearestOne)
{
    Document document = documentOf(
        R"({"version": 1, "emitters": [{"emission": {"rate": 5}, "shape": "spere", "bogus": 1}]})");
    EXPECT_EQ(findingsAfterRemedies(document), 0u);
    EXPECT_EQ(document.json()["emitters"][0]["shape"], "sphere");
    EXPECT_FALSE(document.json()["emitters"][0].contains("bogus"));
}

TEST(DocumentFindings, aFindingStatesItsPointerAndLine)
{
    const auto findings = findingsOf(documentOf("{\n  \"version\": 1,\n  \"duration\": -1\n}\n"));
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].diagnostic.pointer, "/duration");
    EXPECT_EQ(findings[0].diagnostic.line, 3);
    EXPECT_FALSE(findings[0].diagnostic.warning);
}

TEST(DocumentFindings, theLibraryHasNoErrors)
{
    for (const base::EmbeddedText& file : preset::presetLibrary())
        for (const DocumentFinding& finding : findingsOf(documentOf(std::string(file.text))))
            EXPECT_TRUE(finding.diagnostic.warning) << file.name << toString(finding.diagnostic);
}

} // namespace
} // namespace fx::editor
