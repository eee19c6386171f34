//! Which points does a file name, and what is printed for them?

use catoptra_core::Rgb;
use catoptra_core::glam::DVec3;
use catoptra_tracer::{InvalidReceiver, Irradiance, Receiver};
use serde_json::{Value, json};

use crate::numbers::in_full;
use crate::rows::{Form, Rows};

/// A point and the normal there.
pub(super) const POINT: Form<Receiver> = Form {
    numbers: [6, 6],
    finite: 6,
    says: "six numbers",
    help: "a line is six numbers with spaces between: a point and a normal, x y z nx ny nz",
    make: |numbers| {
        let receiver = Receiver::new(DVec3::from_slice(numbers), DVec3::from_slice(&numbers[3..]));
        receiver.map_err(|error| match error {
            InvalidReceiver::NoNormal => (3, error.to_string()),
            _ => (0, error.to_string()),
        })
    },
};

/// A line for each line: irradiance and its standard error.
pub(super) fn as_text(points: &Rows<Receiver>, found: &[Irradiance]) -> String {
    points.answered(found.iter().map(|found| {
        let numbers = [found.mean, found.error].map(Rgb::to_array);
        numbers.as_flattened().iter().map(|v| in_full(*v)).collect::<Vec<_>>().join(" ")
    }))
}

/// Points with what was found there.
pub(super) fn as_json(scene: &str, receivers: &[Receiver], found: &[Irradiance]) -> Value {
    let points: Vec<Value> = receivers
        .iter()
        .zip(found)
        .map(|(receiver, found)| {
            json!({
                "point": receiver.point().to_array(),
                "normal": receiver.normal().to_array(),
                "irradiance": found.mean.to_array(),
                "error": found.error.to_array(),
            })
        })
        .collect();
    json!({ "scene": scene, "points": points })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        Rows::parse(text.as_bytes(), "p", &POINT).err().map_or_else(String::new, |error| error.to_string())
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let cases = [
            ("1 2 3 0 1 0\n\n1 2 x 0 1 0", "p:3:5: `x` is no number"),
            ("1 2 3 0 1", "p:1:10: six numbers are a line, and this one has 5"),
            ("1 2 3 0 1 0 7", "p:1:13: six numbers are a line, and this one has 7"),
            ("# é\n 1 2 3 0 -0 0", "p:2:8: the normal must not be zero"),
            ("1 NaN 3 0 1 0", "p:1:3: `NaN` is not finite"),
            ("1 2 1e999 0 1 0", "p:1:5: `1e999` is not finite"),
            ("1, 2, 3, 0, 1, 0", "p:1:1: `1,` is no number"),
        ];
        for (text, words) in cases {
            assert_eq!(fault(text), words, "{text}");
        }
        assert!(Rows::parse(b"1 2 3 0 1 0\n\xff", "p", &POINT).is_err());
    }

    #[test]
    fn blank_lines_and_remarks_stay_where_they_are() {
        let text = "\u{feff}# a\r\n\n\t1 2\t3 0 9 0 \n #b\n";
        let read = Rows::parse(text.as_bytes(), "p", &POINT).ok().unwrap();
        let receivers: Vec<Receiver> = read.iter().copied().collect();
        assert_eq!(receivers, [Receiver::new(DVec3::new(1.0, 2.0, 3.0), DVec3::Y).unwrap()]);
        let grey = catoptra_core::Rgb::grey;
        let found = Irradiance { mean: grey(0.5), error: grey(0.0) };
        assert_eq!(as_text(&read, &[found]), "# a\n\n0.5 0.5 0.5 0 0 0\n #b\n");
        assert_eq!(as_text(&Rows::parse(b"", "p", &POINT).ok().unwrap(), &[]), "");
    }
}
