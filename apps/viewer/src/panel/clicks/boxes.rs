//! Do boxes over the picture stay until they are closed?

use super::*;
use crate::guard::Next;
use crate::viewer::Broken;

#[test]
fn what_is_wrong_with_a_file_stands_there_until_it_is_read_again() {
    let mut bench = Bench::new("ball");
    let source = Next::Open("broken.kdl".into());
    bench.viewer.error = Some(Broken { report: "line 3 is wrong".to_owned(), source: source.clone() });
    assert!(bench.frames(3).iter().any(|(text, _)| text == "line 3 is wrong"));
    bench.click("Retry");
    assert_eq!(bench.viewer.take_next(), Some(source));
}

#[test]
fn what_has_failed_is_shown_until_it_is_closed() {
    let mut bench = Bench::new("ball");
    bench.viewer.failure = Some("it was not saved".to_owned());
    assert!(bench.frames(3).iter().any(|(text, _)| text == "it was not saved"));
    bench.click("Close");
    assert_eq!(bench.viewer.failure, None);
}
