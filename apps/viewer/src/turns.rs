//! In how many passes does egui meet what a person did? In one, unless something moves the keyboard's focus: egui moves
//! it as a pass begins, so that what was typed before Tab and met in the same pass would be lost.

use egui::{Context, Event, FullOutput, Key, RawInput, Ui};

/// Runs egui over the input, in as many passes as that takes.
pub(crate) fn run(context: &Context, mut input: RawInput, mut show: impl FnMut(&mut Ui)) -> FullOutput {
    let mut turns = split(std::mem::take(&mut input.events)).into_iter();
    input.events = turns.next().unwrap_or_default();
    let mut output = context.run_ui(input.take(), &mut show);
    for events in turns {
        input.events = events;
        output.append(context.run_ui(input.take(), &mut show));
    }
    output
}

/// What is met pass by pass: each event that moves the focus ends one, and begins one if it is met first.
fn split(events: Vec<Event>) -> Vec<Vec<Event>> {
    let (mut turns, mut turn) = (Vec::new(), Vec::new());
    for event in events {
        let ends = moves(&event);
        if moves_at_once(&event) && !turn.is_empty() {
            turns.push(std::mem::take(&mut turn));
        }
        turn.push(event);
        if ends {
            turns.push(std::mem::take(&mut turn));
        }
    }
    if turns.is_empty() || !turn.is_empty() {
        turns.push(turn);
    }
    turns
}

/// Whether this takes the focus away before what came earlier in the pass is met.
fn moves_at_once(event: &Event) -> bool {
    matches!(event, Event::Key { key: Key::Tab | Key::Escape, pressed: true, .. })
}

/// Whether the focus may be another after this.
fn moves(event: &Event) -> bool {
    moves_at_once(event)
        || matches!(event, Event::Key { key: Key::Enter, pressed: true, .. })
        || matches!(event, Event::PointerButton { pressed: false, .. })
}

#[cfg(test)]
mod tests {
    use egui::Modifiers;

    use super::*;

    fn tab(pressed: bool) -> Event {
        Event::Key { key: Key::Tab, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE }
    }

    fn text(words: &str) -> Event {
        Event::Text(words.to_owned())
    }

    #[test]
    fn nothing_is_lost_and_order_is_kept() {
        let events = vec![text("a"), text("b"), tab(true), tab(false), text("c"), tab(true)];
        let turns = split(events.clone());
        let lengths: Vec<usize> = turns.iter().map(Vec::len).collect();
        assert_eq!(lengths, [2, 1, 2, 1]);
        assert_eq!(turns.concat(), events);
        assert_eq!(split(Vec::new()), [Vec::new()]);
        assert_eq!(split(vec![tab(true)]), [vec![tab(true)]]);
    }

    #[test]
    fn what_is_typed_before_and_after_tab_is_all_there() {
        let (context, mut numbers) = (Context::default(), [1.0, 2.0, 3.0]);
        let frame = |numbers: &mut [f64; 3], events: Vec<Event>| {
            run(&context, RawInput { events, ..Default::default() }, |ui| {
                for number in &mut *numbers {
                    ui.add(egui::DragValue::new(number));
                }
            });
        };
        frame(&mut numbers, Vec::new());
        let press = || [tab(true), tab(false)];
        let digits = |number: &str| number.chars().map(|digit| text(&digit.to_string())).collect::<Vec<_>>();
        let typed = ["", "1500", "900", "7"].map(digits);
        frame(&mut numbers, typed.into_iter().flat_map(|digits| digits.into_iter().chain(press())).collect());
        assert_eq!(numbers, [1500.0, 900.0, 7.0]);
    }
}
