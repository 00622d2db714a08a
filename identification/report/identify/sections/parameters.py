"""All parameters with their uncertainty, and what is special of each."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join
from identification.outcome import HIDDEN
from identification.report.identify.subject import Subject
from identification.report.parameter_table import parameter_table

TITLE = "Parameters"
ORDER = 60

#: Distance from a bound, in parts of the parameter's scale, at which the consistent model stands on it.
_AT = 1e-4


def render(subject: Subject) -> Markup:
    text = (
        f"Standard deviations are those {subject.results['method']['std']}. Bars are relative standard deviations on a"
        " logarithmic scale from 0.01 to 1000 %; above 30 % they change their colour."
    )
    if subject.consistent is not None:
        text += " The consistent value is the same parameter of bodies that matter can have."
    beside = {} if subject.consistent is None else {"consistent value": _consistent(subject)}
    table = parameter_table(subject.results["parameters"], _states(subject), beside)
    return join(element("p", text), table, _payloads(subject))


def _states(subject: Subject) -> dict[str, Content]:
    result: dict[str, Content] = {}
    bounds = {p.name: p.lower for p in subject.found.regressors.model.base_parameters}
    consistent = _consistent(subject)
    for name, one in subject.results["parameters"].items():
        lower, value = bounds[name], one["value"]
        usual = "given" if one["fixed"] else "" if one["essential"] or value is None else "not essential"
        doubts = [] if one["identifiable"] else [f"not excited: {HIDDEN}"]
        if lower is not None and value is not None and value < lower:
            doubts.append("below its bound")
        if lower is not None and name in consistent:
            scale = abs(value or 0.0) + (one["std"] if one["identifiable"] else 0.0)
            if consistent[name] - lower <= _AT * scale:
                doubts.append("consistent value at its bound")
        result[name] = [element("span", usual, class_="faint"), " "] if usual else []
        result[name] = [result[name], element("span", "; ".join(doubts), class_="state")]
    return result


def _consistent(subject: Subject) -> dict[str, float]:
    """Base parameters of the consistent model that the data show."""
    model = subject.results["consistent"]
    known = {} if model is None else model["base_parameters"]
    return {name: one["value"] for name, one in known.items() if one["value"] is not None}


def _payloads(subject: Subject) -> Markup | None:
    tables = []
    for name, values in subject.results["payloads"].items():
        states: dict[str, Content] = {key: "given" if one["known"] else "" for key, one in values.items()}
        tables += [element("h3", f"Payload {name}, in the tool frame"), parameter_table(values, states)]
    return join(tables) if tables else None
