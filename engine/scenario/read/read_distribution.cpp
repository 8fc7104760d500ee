#include <algorithm>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

using Names = std::vector<std::string>;

void check_range(const Element& parent) {
  const Element range = parent.child("Range");
  if (!range) return;
  const double low = range.number("lowerLimit");
  if (range.number("upperLimit") < low) range.error("its upper limit is below its lower limit", "exchange them");
}

void check_single(const Element& distribution, Names& varied) {
  varied.push_back(distribution.parameter_name("parameterName"));
  if (const Element set = distribution.child("DistributionSet")) {
    for (const Element& element : set.children("Element")) element.text("value");
  } else if (const Element range = distribution.child("DistributionRange")) {
    if (range.number("stepWidth") <= 0.0) range.error("its steps lead nowhere", "give a stepWidth above 0");
    check_range(range);
  }
}

void check_several(const Element& distribution, Names& varied) {
  const Element sets = distribution.required("ValueSetDistribution");
  for (const Element& set : sets.children("ParameterValueSet")) {
    set.text_or("name", "");
    for (const Element& assignment : set.children("ParameterAssignment")) {
      varied.push_back(assignment.parameter_name("parameterRef"));
      assignment.text_or("value", "");
    }
  }
}

void check_stochastic(const Element& distribution, Names& varied) {
  varied.push_back(distribution.parameter_name("parameterName"));
  for (const char* kind : {"NormalDistribution", "LogNormalDistribution"}) {
    if (const Element found = distribution.child(kind)) {
      found.number("expectedValue");
      found.number("variance", 0.0);
      check_range(found);
    }
  }
  if (const Element found = distribution.child("PoissonDistribution")) {
    found.number("expectedValue", 0.0);
    check_range(found);
  }
  if (const Element found = distribution.child("UniformDistribution")) check_range(found);
  for (const Element& element : distribution.child("ProbabilityDistributionSet").children("Element")) {
    element.text("value");
    element.number("weight", 0.0);
  }
  for (const Element& bin : distribution.child("Histogram").children("Bin")) {
    bin.number("weight", 0.0);
    check_range(bin);
  }
}

/// Checks that the varied names are parameters of the scenario, if that can be read.
void check_names(Reading& reading, const Element& scenario_file, const Names& varied) {
  const std::string path = scenario_file.text("filepath");
  if (path.empty()) return;
  const auto text = reading.files.read(path);
  if (!text) {
    scenario_file.warning(fmt::format("scenario {}: {}", path, text.error().what), text.error().remedy);
    return;
  }
  const auto file = parse_xml(*text, path);
  Names declared;
  for (const Element& declaration : root_of(*file).child("ParameterDeclarations").children("ParameterDeclaration"))
    declared.push_back(declaration.parameter_name("name"));
  for (const std::string& name : varied) {
    if (std::find(declared.begin(), declared.end(), name) == declared.end()) {
      scenario_file.error(fmt::format("{} has no parameter named \"{}\"", path, name),
                          "vary a parameter that the scenario declares");
    }
  }
}

}  // namespace

void check_distribution(Reading& reading, const Element& distribution) {
  Names varied;
  const Element deterministic = distribution.child("Deterministic");
  const Element stochastic = distribution.child("Stochastic");
  if (!deterministic && !stochastic) distribution.error("it varies nothing", "add <Deterministic> or <Stochastic>");
  for (const Element& single : deterministic.children("DeterministicSingleParameterDistribution"))
    check_single(single, varied);
  for (const Element& several : deterministic.children("DeterministicMultiParameterDistribution"))
    check_several(several, varied);
  if (stochastic) {
    stochastic.number("numberOfTestRuns", 0.0);
    stochastic.number_or("randomSeed", 0.0);
    for (const Element& found : stochastic.children("StochasticDistribution")) check_stochastic(found, varied);
  }
  if (const Element file = distribution.required("ScenarioFile")) check_names(reading, file, varied);
}

}  // namespace septet::scenario
