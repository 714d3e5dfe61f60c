#!/usr/bin/env python3
"""Man pages and completions of the command line, made from what `wrinkle --help` says: document.py PROGRAM FOLDER."""

import pathlib
import re
import subprocess
import sys

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])


def help_of(*command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout


def options_of(text):
    """Long options, each with its first line of explanation."""
    found = re.findall(r"^  (?:-\w,)?(--[a-z-]+)(?:[ =].*?)?(?:  +(.*))?$", text, re.M)
    return {name: about.strip() for name, about in found}


def commands_of(text):
    return dict(re.findall(r"^  ([a-z-]+)  +(\S.*)$", text.split("Subcommands:")[1], re.M))


top = help_of()
commands = commands_of(top)
del commands["bench"]  # a program of its own, which is not installed
version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
options = {name: options_of(help_of(name)) for name in commands}
assert "run" in commands and "--output" in options["run"], "the form of --help has changed"

# Step: a man page for the program, and one for every command
for name, about in {"": "bump mapping after the render", **commands}.items():
    page = f"wrinkle-{name}" if name else "wrinkle"
    subprocess.run(["help2man", "--no-info", f"--version-string={version}", f"--name={about[0].lower() + about[1:]}",
                    f"--output={folder / (page + '.1')}", f"{program} {name}".strip()], check=True)
    text = (folder / f"{page}.1").read_text()
    (folder / f"{page}.1").write_text(re.sub(r"^\.TH \S+", f".TH {page.upper()}", text, flags=re.M))

# Step: completions
words = " ".join([*commands, "help", "version", *options_of(top)])
cases = "\n".join(f"        {name}) words='{' '.join(found)}' ;;" for name, found in options.items())
(folder / "wrinkle.bash").write_text(f"""# bash completion of wrinkle
_wrinkle() {{
    local words='{words}' word=${{COMP_WORDS[COMP_CWORD]}}
    COMPREPLY=()
    [ "$COMP_CWORD" -le 1 ] || case ${{COMP_WORDS[1]}} in
{cases}
    esac
    [[ $COMP_CWORD -gt 1 && $word != -* ]] || COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _wrinkle wrinkle
""")


def quoted(text):
    return re.sub(r"""(['"\[\]:\\])""", "", text)


listed = "\n".join(f"    '{name}:{quoted(about)}'" for name, about in commands.items())
cases = "\n".join(f"    {name}) _arguments " + " ".join(f"'{o}[{quoted(a)}]'" for o, a in found.items()) +
                  " '*:file:_files' ;;" for name, found in options.items())
(folder / "_wrinkle").write_text(f"""#compdef wrinkle
local -a commands=(
{listed}
)
if (( CURRENT == 2 )); then
    _describe command commands
    return
fi
local command=$words[2]
shift words
(( CURRENT-- ))
case $command in
{cases}
esac
""")

lines = [f"complete -c wrinkle -n __fish_use_subcommand -f -a {name} -d '{quoted(about)}'"
         for name, about in commands.items()]
lines += [f"complete -c wrinkle -n '__fish_seen_subcommand_from {name}' -l {option[2:]} -d '{quoted(about)}'"
          for name, found in options.items() for option, about in found.items()]
(folder / "wrinkle.fish").write_text("\n".join(lines) + "\n")
