#include <fmt/format.h>
#include <spawn.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "cli/commands.h"
#include "cli/options.h"
#include "watch/watch.h"

namespace wrinkle::cli {

namespace {

struct WatchArguments {
    WatchOptions options;
    bool no_open = false;
};

/// In the user's browser, where there is a desktop.
void open_page(const std::string& url) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    std::string program = "xdg-open", address = url;
    char* arguments[] = {program.data(), address.data(), nullptr};
    pid_t child = 0;
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);  // Ctrl-C is kept from our own threads only
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    ::posix_spawnp(&child, program.c_str(), nullptr, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
}

}  // namespace

void add_watch(CLI::App& app) {
    auto arguments = std::make_shared<WatchArguments>();
    CLI::App* command =
        app.add_subcommand("watch", "Evaluate a scene whenever it changes, and show it in a browser on this machine");
    command->add_option("SCENE", arguments->options.scene, "scene file (TOML)")->required();
    command->add_option("--frame", arguments->options.frame, "frame number, for names with ####")->type_name("N");
    command->add_option("--port", arguments->options.port, "of 127.0.0.1; without it any that is free")
        ->type_name("PORT")
        ->check(CLI::Range(1024, 65535));
    command->add_flag("--no-open", arguments->no_open, "print the page's address, and open no browser");
    add_device_option(*command, arguments->options.device);
    command->callback([arguments] {
        arguments->options.serving = [arguments](const std::string& url) {
            fmt::print("watching {}: {} (Ctrl-C ends it)\n", arguments->options.scene.string(), url);
            std::fflush(stdout);
            if (!arguments->no_open) open_page(url);
        };
        watch(arguments->options);
    });
}

}  // namespace wrinkle::cli
