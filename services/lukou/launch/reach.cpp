#include "services/lukou/launch/reach.hpp"

#include <algorithm>
#include <sstream>

#include "common/lockstep/roster.hpp"
#include "services/lukou/launch/shell_word.hpp"

namespace lukou::launch {
namespace {

/// ssh hands a line of text to a shell of another host; whatever else stands here is handed our words and variables.
bool is_ssh(const std::vector<std::string>& prefix) {
  return std::filesystem::path(prefix.front()).filename() == "ssh";
}

}  // namespace

std::filesystem::path Reach::identity(const std::string& role) const { return keys.empty() ? keys : keys / role; }

std::vector<std::string> Reach::environment(const std::string& role) const {
  // Ours, of the observer's, would be handed on otherwise.
  std::vector<std::string> variables = {"LUKOU_IDENTITY=" + identity(role).string()};
  std::string list;
  for (const std::string& peer : peers) list += (list.empty() ? "" : ",") + peer;
  variables.push_back("LUKOU_PEERS=" + list);
  return variables;
}

Expected<std::map<std::string, std::vector<std::string>>> prefixes(const std::vector<std::string>& texts,
                                                                   std::uint32_t rsus) {
  std::vector<std::string> roles = roles_of_a_run(rsus);
  roles.emplace_back(kClockRole);
  std::map<std::string, std::vector<std::string>> found;
  for (const std::string& text : texts) {
    const std::string where = "--prefix " + text;
    const std::size_t at = text.find('=');
    const std::string role = text.substr(0, at);
    if (at == std::string::npos || std::ranges::find(roles, role) == roles.end()) {
      std::string known;
      for (const std::string& one : roles) known += " " + one;
      return Error{where, "must be ROLE=COMMAND; the roles of this run are" + known};
    }
    std::istringstream words(text.substr(at + 1));
    std::vector<std::string> prefix;
    for (std::string word; words >> word;) prefix.push_back(word);
    if (prefix.empty()) return Error{where, "has no command behind the `=`"};
    if (is_ssh(prefix) && (role == kClockRole || role == kRecorderRole)) {
      return Error{where, "the " + role + " works in the result folder, so it stays on this host"};
    }
    if (!found.emplace(role, prefix).second) return Error{where, "is the second for " + role};
  }
  return found;
}

ChildSpec behind(const std::vector<std::string>& prefix, const std::filesystem::path& leash, ChildSpec child) {
  child.core.reset();
  std::vector<std::string> command = prefix;
  if (is_ssh(prefix)) {
    std::string line = "exec env";
    for (const std::string& variable : child.environment) line += " " + shell_word(variable);
    line += " " + shell_word(leash.string()) + " leash --";
    for (const std::string& word : child.command) line += " " + shell_word(word);
    command.push_back(line);
    child.environment.clear();
    child.leashed = true;
  } else {
    command.insert(command.end(), child.command.begin(), child.command.end());
  }
  child.command = std::move(command);
  return child;
}

}  // namespace lukou::launch
