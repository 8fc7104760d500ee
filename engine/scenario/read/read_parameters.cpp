#include <algorithm>

#include <fmt/format.h>

#include "engine/scenario/model/parameter_value.hpp"
#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

/// The constraints that the value breaks, as text; empty where it fulfils all of a group, of any group.
std::string broken_constraints(const Element& declaration, std::string_view value) {
  bool any = false;
  std::string groups;
  for (const Element& group : declaration.children("ConstraintGroup")) {
    bool all = true;
    std::string rules;
    for (const Element& constraint : group.children("ValueConstraint")) {
      const std::string limit = constraint.text("value");
      all = compare_values(read_rule(constraint), value, limit) && all;
      rules += fmt::format("{}{} {}", rules.empty() ? "" : " and ", constraint.text_or("rule", ""), limit);
    }
    any = any || all;
    groups += (groups.empty() ? "" : ", or ") + rules;
  }
  return any ? "" : groups;
}

}  // namespace

Element with_declared_parameters(const Element& element, const Parameters& assigned) {
  if (!element) return element;
  // One table for all declarations, which grows from one to the next: a value may use parameters declared before it.
  const auto parameters = std::make_shared<Parameters>(element.parameters());
  for (const auto& [name, value] : assigned) (*parameters)[name] = value;
  for (const Element& found : element.child("ParameterDeclarations").children("ParameterDeclaration")) {
    const Element declaration = found.with(parameters);
    const std::string name = declaration.text("name");
    const std::string type = declaration.text_or("parameterType", "");
    std::string value = declaration.text_or("value", "");
    const auto given = assigned.find(name);
    if (given != assigned.end()) value = given->second;
    const char* whose = given != assigned.end() ? "given to" : "of";
    if (!is_of_type(value, type)) {
      const std::string what =
          fmt::format("\"{}\" {} {} is no value of type {}", value.substr(0, 60), whose, name, type);
      if (given != assigned.end())
        declaration.error(what, fmt::format("give a value of type {}", type));
      else
        declaration.warning(what, "correct the value or its type");
    } else if (const std::string broken = broken_constraints(declaration, value); !broken.empty()) {
      declaration.error(fmt::format("\"{}\" {} {} breaks its constraints", value.substr(0, 60), whose, name),
                        "give a value that is " + broken.substr(0, 200));
    }
    (*parameters)[name] = std::move(value);
  }
  return element.with(parameters);
}

Element with_outside_parameters(const Element& root, const std::vector<ParameterValue>& values) {
  Parameters assigned;
  for (const ParameterValue& parameter : values) assigned[parameter.name] = parameter.value;
  if (!root || assigned.empty()) return with_declared_parameters(root);
  std::string names;
  const auto declarations = root.child("ParameterDeclarations").children("ParameterDeclaration");
  for (const Element& declaration : declarations) names += (names.empty() ? "" : ", ") + declaration.text("name");
  for (const auto& parameter : assigned) {
    const std::string& name = parameter.first;  // clang 14 cannot capture a structured binding.
    const auto is_it = [&](const Element& declaration) { return declaration.text("name") == name; };
    if (std::none_of(declarations.begin(), declarations.end(), is_it)) {
      root.error(fmt::format("the scenario has no parameter named \"{}\"", name.substr(0, 60)),
                 names.empty() ? "it has no parameters at all" : "name one of: " + names);
    }
  }
  return with_declared_parameters(root, assigned);
}

void read_values(Reading& reading, const Element& root) {
  std::vector<std::string>& values = reading.scenario.values;
  const auto add = [&](auto& names, const std::string& name, const std::string& value) {
    names[name] = static_cast<ValueIndex>(values.size());
    values.push_back(value);
  };
  for (const auto& [name, value] : root.parameters()) {
    add(reading.parameters, name, value);
    reading.scenario.parameters.emplace_back(name, value);
  }
  for (const Element& declaration : root.child("VariableDeclarations").children("VariableDeclaration")) {
    const std::string type = declaration.text("variableType");
    const std::string value = declaration.text_or("value", "");
    if (!is_of_type(value, type)) {
      declaration.warning(fmt::format("\"{}\" is no value of type {}", value.substr(0, 60), type),
                          "correct the value or its type");
    }
    add(reading.variables, declaration.text("name"), value);
  }
}

ValueIndex read_value_reference(Reading& reading, const Element& element, const char* attribute) {
  const bool variable = std::string_view(attribute) == "variableRef";
  const auto& names = variable ? reading.variables : reading.parameters;
  const std::string name = element.parameter_name(attribute);
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  if (!name.empty() && !reading.names_are_elsewhere) {
    element.error(fmt::format("no {} is named \"{}\"", variable ? "variable" : "parameter", name.substr(0, 60)),
                  "declare it at the beginning of the file");
  }
  if (reading.scenario.values.empty()) reading.scenario.values.emplace_back();
  return 0;
}

}  // namespace septet::scenario
