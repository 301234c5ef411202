#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/document/emitter_starters.h"

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

TEST(DocumentFindings, whatAnotherKindOrShapeLeavesIsTakenOutByItsRemedy)
{
    Document document = documentOf(R"({"version": 1, "emitters": [{"emission": {"rate": 5}, "shape": "point",
        "angleDegrees": 10, "size": 1, "opticalDepth": 2, "detailAmount": 1, "albedoOverLife": [0.9, 0.9, 0.9],
        "appearance": {"kind": "sprite"}}]})");
    EXPECT_GE(findingsOf(document).size(), 5u);
    EXPECT_EQ(findingsAfterRemedies(document), 0u);
    EXPECT_FALSE(document.json()["emitters"][0].contains("detailAmount"));
    EXPECT_TRUE(document.json()["emitters"][0].contains("appearance"));
}

TEST(DocumentFindings, membersThatAreRequiredAreNotTakenOut)
{
    const auto findings = findingsOf(documentOf(R"({"version": 1, "blocks": [{"types": [
        {"name": "a", "balls": [{}]}, {"name": "b", "balls": [{}]}], "blocks": [{"type": "a"}]}]})"));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].diagnostic.pointer, "/blocks/0/types/1/name"); // no block has it; remove it
    EXPECT_FALSE(findings[0].remedy.has_value());
}

TEST(DocumentFindings, absentMembersOfOtherKindsAreUnused)
{
    const Document sprite =
        documentOf(R"({"version": 1, "emitters": [{"emission": {"rate": 5}, "opticalDepth": 2,
        "appearance": {"kind": "sprite"}}]})");
    const auto unused = unusedMembersOf(sprite, "/emitters/0");
    ASSERT_TRUE(unused.contains("/emitters/0/detailAmount"));
    EXPECT_EQ(unused.at("/emitters/0/detailAmount"),
              "has no effect on the kind \"sprite\", it is of the kind \"medium\"");
    EXPECT_TRUE(unused.contains("/emitters/0/angleDegrees"));  // of cones
    EXPECT_FALSE(unused.contains("/emitters/0/opticalDepth")); // a finding has it
    EXPECT_FALSE(unused.contains("/emitters/0/lifetime"));
    const Document medium =
        documentOf(R"({"version": 1, "emitters": [{"emission": {"rate": 5}, "appearance": {}}]})");
    const auto ofMedium = unusedMembersOf(medium, "/emitters/0");
    EXPECT_FALSE(ofMedium.contains("/emitters/0/detailAmount"));
    EXPECT_TRUE(ofMedium.contains("/emitters/0/appearance/luminance"));
}

TEST(EmitterStarters, areValidWithoutWarnings)
{
    Document document = documentOf(R"({"version": 1, "emitters": []})");
    size_t count = 0;
    for (const EmitterStarter& starter : emitterStarters())
        ASSERT_TRUE(document.insert("/emitters", count++, starterEmitter(starter, document.json())).ok());
    EXPECT_GE(count, 5u);
    for (const DocumentFinding& finding : findingsOf(document))
        ADD_FAILURE() << toString(finding.diagnostic);
}

TEST(DocumentFindings, theLibraryHasNoErrors)
{
    for (const base::EmbeddedText& file : preset::presetLibrary())
        for (const DocumentFinding& finding : findingsOf(documentOf(std::string(file.text))))
            EXPECT_TRUE(finding.diagnostic.warning) << file.name << toString(finding.diagnostic);
}

} // namespace
} // namespace fx::editor
