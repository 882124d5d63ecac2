"""Settings: where they come from, which wins, and what is said of mistakes."""

import json
import re
import tomllib

import pytest
from shell import call, json_of

from bayesmap import BeamMixture, Gaussian, StudentT
from bayesmap.cli.command import as_toml, layered, read_file, read_pairs
from bayesmap.cli.keys import SECTIONS, ExportSettings
from bayesmap.cli.translation import sensor_of
from bayesmap.errors import BadInput


def write(folder, text):
    path = folder / "my.toml"
    path.write_text(text)
    return path


def test_the_printed_configuration_is_the_effective_one(tmp_path):
    first = call("config").stdout
    assert tomllib.loads(first).keys() == SECTIONS.keys()
    path = write(tmp_path, first)
    assert call("config", "-c", path).stdout == first
    assert read_file(path).keys() == SECTIONS.keys()
    for section, settings in SECTIONS.items():
        assert layered(section, read_file(path)) == settings()


def test_every_kind_of_value_survives_the_round_trip(tmp_path):
    set_ = ["no_return=inf", "max_range=20", "sensor=student-t:0.1,dof=4", 'world=my "map" 🗺\x7f.txt']
    arguments = [part for pair in set_ for part in ("--set", pair)]
    printed = call("config", *arguments).stdout
    again = call("config", "-c", write(tmp_path, printed)).stdout
    assert again == printed
    values = tomllib.loads(printed)["infer"]
    assert values["no_return"] == float("inf")
    assert values["max_range"] == 20.0
    assert tomllib.loads(printed)["simulate"]["world"] == 'my "map" 🗺\x7f.txt'


def test_json_is_one_document():
    document = json.loads(call("config", "--json --set no_return=inf").stdout)
    assert document["schema_version"] == 1
    assert document["settings"]["infer"]["no_return"] == "inf"


def test_flags_win_over_set_over_file_over_defaults(office, tmp_path, short):
    path = write(tmp_path, "draws = 3\n[infer]\nchains = 1\nwarmup = 1\nthin = 2\n")
    options = "--set warmup=2 --set thin=3 --thin 1 --json --resolution 0.25 --cells binary"
    document = json_of("infer", office, "-o", tmp_path / "run", "-c", path, options)
    asked = {name: document[name] for name in ("draws", "chains", "warmup", "thin", "order")}
    assert asked == {"draws": 3, "chains": 1, "warmup": 2, "thin": 1, "order": "radial"}


def test_a_bare_key_holds_for_all_commands_that_have_it(tmp_path):
    layer = read_file(write(tmp_path, "seed = 7\n[demo]\nseed = 8\n"))
    assert [layered(section, layer).seed for section in ("infer", "simulate", "demo")] == [7, 7, 8]
    assert read_pairs(["seed=3"], "infer") == {"infer": {"seed": 3}}
    assert read_pairs(["demo.seed=3"], "infer") == {"demo": {"seed": 3}}


@pytest.mark.parametrize(("text", "message"), [
    ("[infer]\nresoluton = 1\n", "did you mean 'resolution'?"),
    ("[infer]\nmax-range = 1\n", "did you mean 'max_range'?"), ("[infre]\nchains = 1\n", "did you mean 'infer'?"),
    ("chians = 1\n", "did you mean 'chains'?"),
    ("[infer]\nchains = 'two'\n", "chains must be a whole number of 1 or more, got 'two'"),
    ("[infer]\nchains = 2.5\n", "chains must be a whole number of 1 or more, got 2.5"),
    ("[infer]\nstrict = 1\n", "strict must be true or false, got 1"),
    ("[infer]\nprior = true\n", "prior must be a number from 0 to 1, got True"),
    ("[infer]\ncoupling = true\n", "coupling must be a number from 0 to 50, or fit, got True"),
    ('[infer]\ncoupling = "some"\n', "coupling must be a number from 0 to 50, or fit, got 'some'"),
    ("[infer]\nmethod = 'magic'\n", "method must be one of gibbs, block, propagate, importance, exact, got"),
    ("seed = -1\n", "--seed must be a whole number of 0 or more, got -1"), ("[infer\n", "not valid TOML"),
])  # fmt: skip
def test_mistakes_in_a_file_exit_3_and_name_it(tmp_path, text, message):
    path = write(tmp_path, text)
    result = call("config", "-c", path)
    assert result.exit_code == 3
    assert result.stdout == ""
    assert result.stderr.startswith(f"bayesmap: error: {path}: ")
    assert message in result.stderr


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(BadInput, match=r"nothing\.toml: cannot be read"):
        read_file(tmp_path / "nothing.toml")


def test_only_one_section_is_printed_where_only_one_is_given():
    lines = as_toml({"export": ExportSettings(mode="scale")}).splitlines()
    assert [line for line in lines if line.startswith("[")] == ["[export]"]
    assert (
        'mode = "scale"       # Occupied, free and unknown; or per cent. One of trinary, scale, raw. '
        "Default: trinary for map-server, scale for recordings."
    ) in lines


@pytest.mark.parametrize(("text", "model"), [
    ("default", None), ("gaussian:0.2", Gaussian(0.2)), ("gaussian:0.02,sigma_per_m=0.005", Gaussian(0.02, 0.005)),
    ("gaussian:sigma_m=0.1", Gaussian(0.1)), ("student-t:0.1,dof=3", StudentT(0.1, 3.0)), ("mixture", BeamMixture()),
    ("mixture:0.1,p_random=0.2", BeamMixture(Gaussian(0.1), p_random=0.2)),
    ("mixture:0.1,noise=student-t,dof=2", BeamMixture(StudentT(0.1, 2.0))),
])  # fmt: skip
def test_sensor_models_as_they_are_typed(text, model):
    assert sensor_of(text) == model


@pytest.mark.parametrize(("text", "message"), [
    ("laser", "unknown kind 'laser'; known: default, fit (of infer), gaussian"),
    ("gaussian", "gaussian needs its sigma_m, as in gaussian:0.05"),
    ("gaussian:-0.2", "sigma_m must be a positive number of metres, got -0.2"),
    ("gaussian:nan", "sigma_m must be a positive number"), ("gaussian:wide", "'wide' is not a number"),
    ("gaussian:0.1,0.2", "write '0.2' as name=value"), ("gaussian:0.1,sigma=2", "no parameter 'sigma'"),
    ("mixture:0.1,noise=pink", "noise must be gaussian or student-t"),
    ("mixture:0.1,p_random=2", "p_random must lie inside"),
])  # fmt: skip
def test_mistakes_in_a_sensor_model_are_named(text, message):
    with pytest.raises(BadInput, match=re.escape(message)):
        sensor_of(text)
