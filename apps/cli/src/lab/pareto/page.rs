//! What was found, as a table for programs and as a page for people.

use std::fmt::Write;

use catoptra_tracer::{Instructions, View};

use super::{Lab, Question, Way};

/// One line for each error of each way.
pub(super) fn csv(questions: &[Question]) -> String {
    let mut text = String::from("question,series,setting,time,unit,measure,error\n");
    for question in questions {
        for way in &question.ways {
            for (measure, error) in question.errors.iter().zip(&way.errors) {
                let Way { series, setting, time, .. } = way;
                let (name, unit) = (question.name, question.time);
                let _ =
                    writeln!(text, "{name},\"{series}\",\"{setting}\",{time:.6},{unit},{measure},{error:e}");
            }
        }
    }
    text
}

/// The page: conditions, what to choose, and each question with its picture and table.
pub(super) fn markdown(questions: &[Question], lab: &Lab) -> String {
    let mut text = format!(
        "# Run time against error\n\n\
         Written by `catoptra lab pareto --out benches`; the same numbers for programs are in [pareto.csv](pareto.csv). Errors repeat \
         to the last digit on every machine and with any number of threads; times are those of this machine's processor, least of five or more \
         goes.\n\n## Conditions\n\n{}\n## Which setting for which error\n\n{}",
        conditions(lab),
        choices(questions)
    );
    for question in questions {
        let _ = write!(
            text,
            "\n## {}\n\n{}\n\n![{}]({}.svg)\n\n{}",
            question.title,
            question.words,
            question.title,
            question.name,
            table(question)
        );
    }
    text
}

fn conditions(lab: &Lab) -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpu
        .lines()
        .find_map(|line| line.strip_prefix("model name"))
        .map(|rest| rest.trim_start_matches([' ', '\t', ':']));
    format!(
        "* catoptra {}, {} build, {} {}\n* CPU {}, vector instructions {}\n* {} of tracing; the time that other programs took meanwhile is not counted\n\
         * radiance is linear; FLIP judges the sRGB picture at {:.0} pixels per degree\n",
        env!("CARGO_PKG_VERSION"),
        if cfg!(debug_assertions) { "development" } else { "release" },
        std::env::consts::OS,
        std::env::consts::ARCH,
        cpu.unwrap_or("unknown"),
        Instructions::best().name(),
        crate::words::counted(lab.pool.threads() as u64, "thread"),
        catoptra_lab::Viewing::default().pixels_per_degree,
    )
}

/// For each question and error of a picture, the cheapest way that stays below.
fn choices(questions: &[Question]) -> String {
    let default = View::new(catoptra_core::Camera::default(), catoptra_tracer::Size::new(1, 1));
    let mut text = format!(
        "Without options a picture has one sample a pixel, {} reflections and a weight cut-off of {:.5}. Visibility is always that of \
         exact arithmetic: there is nothing to choose.\n\n| question | error | cheapest way below it | its cost |\n|---|---|---|---|\n",
        default.max_depth, default.weight_cutoff
    );
    for question in questions.iter().filter(|question| question.errors.contains(&"RMSE")) {
        for limit in [0.1, 0.03, 0.01, 0.003, 0.001] {
            let good = question.ways.iter().filter(|way| way.errors[0] <= limit);
            let Some(way) = good.min_by(|a, b| a.time.total_cmp(&b.time)) else { continue };
            let Way { series, setting, time, .. } = way;
            let (title, unit) = (question.title, question.time);
            let _ = writeln!(text, "| {title} | RMSE ≤ {limit} | {series}, {setting} | {time:.2} {unit} |");
        }
    }
    text
}

fn table(question: &Question) -> String {
    let mut text = format!("| way | setting | {} | {} |\n", question.time, question.errors.join(" | "));
    text += &format!("|---|---|{}\n", "--:|".repeat(question.errors.len() + 1));
    for way in &question.ways {
        let errors: Vec<String> = way.errors.iter().map(|error| short(*error)).collect();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} |",
            way.series,
            way.setting,
            short(way.time),
            errors.join(" | ")
        );
    }
    text
}

/// Three digits, or as many as a whole number has.
fn short(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        100.0..1e7 => format!("{number:.0}"),
        0.01..100.0 => format!("{number:.3}"),
        _ => format!("{number:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short_at_any_size() {
        assert_eq!([0.0, 12_345.6, 1.5, 2.5e-6].map(short), ["0", "12346", "1.500", "2.50e-6"]);
    }
}
