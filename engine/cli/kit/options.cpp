// Our commands and options over CLI11's.
#include "cli/kit/options.h"

#include <algorithm>

#include "palpate/base/path_text.h"

// CLI11 looks for this name, and its templates must find it. NOLINTBEGIN(readability-identifier-naming)
namespace CLI::detail {
/// File names are UTF-8.
inline bool lexical_cast(const std::string& input, std::filesystem::path& output) {
  output = palpate::pathOf(input);
  return true;
}
}  // namespace CLI::detail
// NOLINTEND(readability-identifier-naming)

#include <CLI/CLI.hpp>

namespace palpate::app {

static_assert(kAnyNumberOfValues == CLI::detail::expected_max_vector_size);

// --- options

Option* Option::required(bool value) {
  option_->required(value);
  return this;
}
Option* Option::type_name(const std::string& name) {
  option_->type_name(name);
  return this;
}
Option* Option::description(const std::string& text) {
  option_->description(text);
  return this;
}
Option* Option::group(const std::string& name) {
  option_->group(name);
  return this;
}
Option* Option::capture_default_str() {
  option_->capture_default_str();
  return this;
}
Option* Option::default_str(const std::string& text) {
  option_->default_str(text);
  return this;
}
Option* Option::delimiter(char separator) {
  option_->delimiter(separator);
  return this;
}
Option* Option::expected(int count) {
  option_->expected(count);
  return this;
}
Option* Option::expected(int least, int most) {
  option_->expected(least, most);
  return this;
}
Option* Option::allow_extra_args(bool value) {
  option_->allow_extra_args(value);
  return this;
}
Option* Option::check(const Check& check) {
  option_->check(CLI::Validator([check](const std::string& value) { return check(value); }, ""));
  return this;
}
Option* Option::check(const IsMember& names) {
  option_->check(CLI::IsMember(names.names));
  return this;
}
Option* Option::check(ExistingPath /*existing*/) {
  option_->check(CLI::ExistingPath);
  return this;
}
Option* Option::needs(Option* other) {
  option_->needs(other->option_);
  return this;
}
Option* Option::needs(const std::string& other) {
  option_->needs(other);
  return this;
}
Option* Option::excludes(Option* other) {
  option_->excludes(other->option_);
  return this;
}
Option* Option::excludes(const std::string& other) {
  option_->excludes(other);
  return this;
}

std::string Option::get_name() const { return option_->get_name(); }
std::string Option::get_single_name() const { return option_->get_single_name(); }
const std::vector<std::string>& Option::get_snames() const { return option_->get_snames(); }
const std::vector<std::string>& Option::get_lnames() const { return option_->get_lnames(); }
const std::string& Option::get_description() const { return option_->get_description(); }
std::string Option::get_type_name() const { return option_->get_type_name(); }
std::string Option::get_default_str() const { return option_->get_default_str(); }
int Option::get_expected_min() const { return option_->get_expected_min(); }
int Option::get_items_expected_max() const { return option_->get_items_expected_max(); }
bool Option::get_positional() const { return option_->get_positional(); }
std::size_t Option::count() const { return option_->count(); }

// --- commands

struct Command::Impl {
  std::unique_ptr<CLI::App> root;  ///< none in a subcommand
  CLI::App* app = nullptr;
  const Command* parent = nullptr;
  std::vector<std::unique_ptr<Option>> options;
  std::vector<std::unique_ptr<Command>> subcommands;

  /// This option as the commands know it. CLI11 adds some itself, such as --help.
  Option* known(CLI::Option* option) {
    const auto found = std::ranges::find(options, option, [](const auto& one) { return one->option_; });
    if (found != options.end()) return found->get();
    return options.emplace_back(std::make_unique<Option>(*option)).get();
  }
};

Command::Command(const std::string& description, const std::string& name) : impl_(std::make_unique<Impl>()) {
  impl_->root = std::make_unique<CLI::App>(description, name);
  impl_->app = impl_->root.get();
}
Command::Command(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Command::~Command() = default;

Option* Command::add_option(const std::string& name, std::string& value, const std::string& help) {
  return impl_->known(impl_->app->add_option(name, value, help));
}
Option* Command::add_option(const std::string& name, std::filesystem::path& value, const std::string& help) {
  return impl_->known(impl_->app->add_option(name, value, help));
}
Option* Command::add_option(const std::string& name, std::optional<std::string>& value, const std::string& help) {
  return impl_->known(impl_->app->add_option(name, value, help));
}
Option* Command::add_option(const std::string& name, std::optional<std::filesystem::path>& value,
                            const std::string& help) {
  return impl_->known(impl_->app->add_option(name, value, help));
}
Option* Command::add_option(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  return impl_->known(impl_->app->add_option(name, values, help));
}
Option* Command::add_option(const std::string& name, std::vector<std::filesystem::path>& values,
                            const std::string& help) {
  return impl_->known(impl_->app->add_option(name, values, help));
}
Option* Command::add_option(const std::string& name, const std::function<void(const std::vector<std::string>&)>& read,
                            const std::string& help, const std::function<std::string()>& shown) {
  const auto accept = [read](const std::vector<std::string>& words) {
    read(words);
    return true;
  };
  return impl_->known(impl_->app->add_option(name, accept, help, false, shown));
}
Option* Command::add_option_function(const std::string& name, const std::function<void(const std::string&)>& read,
                                     const std::string& help) {
  return impl_->known(impl_->app->add_option_function<std::string>(name, read, help));
}
Option* Command::add_option_function(const std::string& name,
                                     const std::function<void(const std::vector<std::string>&)>& read,
                                     const std::string& help) {
  return impl_->known(impl_->app->add_option_function<std::vector<std::string>>(name, read, help));
}
Option* Command::add_flag(const std::string& name, bool& value, const std::string& help) {
  return impl_->known(impl_->app->add_flag(name, value, help));
}
Option* Command::add_flag_function(const std::string& name, const std::function<void(std::int64_t)>& read,
                                   const std::string& help) {
  return impl_->known(impl_->app->add_flag_function(name, read, help));
}
void Command::set_version_flag(const std::string& name, const std::string& version) {
  impl_->app->set_version_flag(name, version);
}

Command* Command::add_subcommand(const std::string& name, const std::string& help) {
  auto impl = std::make_unique<Impl>();
  impl->app = impl_->app->add_subcommand(name, help);
  impl->parent = this;
  impl_->subcommands.push_back(std::unique_ptr<Command>(new Command(std::move(impl))));
  return impl_->subcommands.back().get();
}
Command* Command::require_subcommand(int count) {
  impl_->app->require_subcommand(count);
  return this;
}
Command* Command::require_subcommand(std::size_t least, std::size_t most) {
  impl_->app->require_subcommand(least, most);
  return this;
}
Command* Command::group(const std::string& name) {
  impl_->app->group(name);
  return this;
}
Command* Command::footer(const std::string& text) {
  impl_->app->footer(text);
  return this;
}
Command* Command::callback(const std::function<void()>& run) {
  impl_->app->callback(run);
  return this;
}
Command* Command::allow_windows_style_options(bool value) {
  impl_->app->allow_windows_style_options(value);
  return this;
}

std::string Command::get_name() const { return impl_->app->get_name(); }
std::string Command::get_description() const { return impl_->app->get_description(); }
std::string Command::version() const { return impl_->app->version(); }
const Command* Command::get_parent() const { return impl_->parent; }
Option* Command::get_option(const std::string& name) { return impl_->known(impl_->app->get_option(name)); }
std::vector<Option*> Command::get_options() {
  std::vector<Option*> options;
  for (CLI::Option* option : impl_->app->get_options()) options.push_back(impl_->known(option));
  return options;
}
std::vector<const Option*> Command::get_options() const {
  std::vector<const Option*> options;
  for (CLI::Option* option : impl_->app->get_options()) options.push_back(impl_->known(option));
  return options;
}
const Option* Command::get_help_ptr() const {
  CLI::Option* help = impl_->app->get_help_ptr();
  return help == nullptr ? nullptr : impl_->known(help);
}
std::size_t Command::count(const std::string& option) const { return impl_->app->count(option); }
Command* Command::get_subcommand(const std::string& name) {
  const CLI::App* wanted = impl_->app->get_subcommand(name);
  return std::ranges::find(impl_->subcommands, wanted, [](const auto& sub) { return sub->impl_->app; })->get();
}
std::vector<Command*> Command::all_subcommands() const {
  std::vector<Command*> commands;
  for (const std::unique_ptr<Command>& sub : impl_->subcommands) commands.push_back(sub.get());
  return commands;
}
std::vector<Command*> Command::get_subcommands() const {
  std::vector<Command*> chosen;
  for (const CLI::App* app : impl_->app->get_subcommands()) {
    const auto sub = std::ranges::find(impl_->subcommands, app, [](const auto& one) { return one->impl_->app; });
    if (sub != impl_->subcommands.end()) chosen.push_back(sub->get());
  }
  return chosen;
}

void Command::parse(const std::vector<std::string>& last_first) {
  std::vector<std::string> words = last_first;
  try {
    impl_->app->parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      impl_->app->exit(error);  // prints the help or the version
      return;
    }
    const bool about_words =
        error.get_name() == "RequiredError" || error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    throw about_words ? UsageError::aboutArguments(error.what()) : UsageError(error.what());
  }
}
std::vector<std::string> Command::remaining() const { return impl_->app->remaining(true); }

}  // namespace palpate::app
